// Other hosts at the console: their components and ports by name, and the wait for what they answer.
#include <catch2/catch.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bindings/console/session.hpp"
#include "bindings/console/worker.hpp"
#include "bindings/lua/reload/lua_host.hpp"
#include "engine/live/answer_question.hpp"
#include "engine/live/running_system.hpp"
#include "engine/system/network.hpp"
#include "engine/trace/recent_curves.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/peer_words.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

using Lines = std::vector<std::string>;

// Another host, ev3, that answers what a test says, or nothing; or as a system answers.
class OneHost final : public Network {
public:
    Expected<void> reach(std::string_view /*path*/, const Port& /*other*/) override { return failure("not here"); }
    void between_ticks(const ActDoor& /*act*/, const QuestionDoor& /*answer*/) override {}
    void before_tick(const MessageDoor& /*deliver*/) override {}
    std::vector<Host> hosts() const override {
        if (system != nullptr) {
            Host host{.name = "ev3", .here = true};
            for (const Component* component : std::as_const(system->system()).components()) {
                for (const Port* port : nezumi::ports_of(*component))
                    host.ports.push_back({path(*component, *port), std::string(port->type_name()), port->direction()});
            }
            return {host};
        }
        return {{.name = "ev3",
                 .here = true,
                 .version = "1",
                 .ports = {{"driver.in", "TimedShortSeq", Direction::in},
                           {"vehicle.current_vel", "TimedVelocity2D", Direction::out},
                           {"vehicle.velocity2D", "TimedVelocity2D", Direction::in}}}};
    }
    bool brought(const ConnectionSpec& /*connection*/) const override { return false; }
    Expected<std::uint64_t> ask(const Question& question) const override {
        asked.push_back(question);
        return asked.size();
    }
    std::optional<Expected<PlainData>> answer(std::uint64_t number) const override {
        if (system == nullptr) return says;
        const auto act = [&](const Act& each, const Actor& who) { return system->act(each, who); };
        return answer_question({system->tree(), system->trace(), act}, asked[number - 1], true,
                               {Actor::Kind::network, "pi"});
    }

    mutable std::vector<Question> asked;
    std::optional<Expected<PlainData>> says;
    RunningSystem* system = nullptr;
};

constexpr const char* it_behavior = "local out = output('out', 'TimedVelocity2D')\n";
constexpr const char* it_system = "network { name = 'pi' }\nbehavior 'it' { script = 'it' }\n";

struct HostsRig : ClockControl {
    explicit HostsRig(const char* behavior = it_behavior, const char* system = it_system) {
        folder.write("behaviors/it.lua", behavior);
        LiveOptions options;
        options.scripts = &lua_scripts();
        options.peer_words = peer_words();
        options.installed = {source_root()};
        options.network = [this](const SystemSpec&, System&) -> Expected<std::unique_ptr<Network>> {
            auto made = std::make_unique<OneHost>();
            network = made.get();
            return made;
        };
        auto loaded = RunningSystem::load(folder.write("s.lua", system), std::move(options));
        REQUIRE(loaded.has_value());
        live = std::move(*loaded);
        SessionOptions session_options;
        session_options.bell = &bell;
        session_options.watch_period = 0;
        session_options.output.show = [this](std::string_view text) { shown += text; };
        session_options.output.show_error = [this](std::string_view text) { shown += "! " + std::string(text); };
        session = std::move(Session::create(*live, *this, std::move(session_options)).value());
    }
    std::string type(std::string text) {
        shown.clear();
        session->submit(std::move(text));
        while (session->is_busy()) session->advance();
        return shown;
    }
    Lines complete(std::string text) {
        std::optional<Completion> found;
        const std::size_t cursor = text.size();
        session->complete(std::move(text), cursor, [&](Completion completion) { found = std::move(completion); });
        while (!found) session->advance();
        return found->candidates;
    }

    bool is_hardware() const override { return false; }
    void pause() override {}
    void resume() override {}
    bool is_paused() const override { return true; }
    void advance(std::int64_t /*ticks*/) override {}
    bool is_advancing() const override { return false; }
    std::uint64_t moves() const override { return 0; }
    void set_speed(double /*factor*/) override {}
    double speed() const override { return 1; }
    void quit() override {}
    std::vector<LogLine> problems() const override { return {}; }

    Scratch folder;
    Bell bell;
    OneHost* network = nullptr;
    std::unique_ptr<RunningSystem> live;
    std::string shown;
    std::unique_ptr<Session> session;
};

}  // namespace

TEST_CASE("other hosts, their components and ports are completed", "[console][network]") {
    HostsRig it;
    CHECK(it.complete("hosts.") == Lines{"ev3"});
    CHECK(it.complete("hosts.ev3.") == Lines{"driver", "vehicle"});
    CHECK(it.complete("connect('ev3/") == Lines{"ev3/vehicle.current_vel"});
    CHECK(it.complete("connect('it.out', 'ev3/") == Lines{"ev3/vehicle.velocity2D"});
    CHECK(it.type("hosts") == "ev3: driver, vehicle");
    CHECK(it.network->asked.empty());
}

TEST_CASE("ports of other hosts are connected by their names", "[console][network]") {
    HostsRig it;
    CHECK(it.type("connect('it.out', 'ev3/vehicle.velocity2D')") == "! connect: not here");  // the network was asked
    CHECK(it.type("connect('ev3/vehicle.current_vel', 'it.out')") == "! connect: not here");
    CHECK(it.type("connect(hosts.ev3.vehicle.current_vel, 'it.out')") == "! connect: not here");
    CHECK(it.network->asked.empty());
}

TEST_CASE("a port of another host that is not connected here is watched", "[console][network]") {
    HostsRig it;
    const auto carries = [&](double stamp, std::int64_t count, const std::string& text) {
        it.network->says = PlainData{.values = {stamp, count, text}, .tables = {}};
    };
    CHECK(it.complete("watch('ev3/v") == Lines{"ev3/vehicle.current_vel", "ev3/vehicle.velocity2D"});
    CHECK(it.type("watch('ev3/vehicle.current_vel')").empty());
    const auto pass = [&] {
        it.shown.clear();
        for (int i = 0; i < 3; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            it.live->tick();
            it.session->after_tick();
        }
        return it.shown;
    };
    CHECK(pass().empty());
    REQUIRE(it.network->asked.size() == 1);  // and is not asked again before it has answered
    CHECK(it.network->asked[0].component == "vehicle");
    CHECK(it.network->asked[0].name == "current_vel");
    carries(0, 0, "{ vx = 0 }");
    CHECK(pass().empty());  // nothing came yet
    carries(1.5, 3, "{ vx = 0.1 }");
    CHECK(pass() == "[1.500] ev3/vehicle.current_vel = { vx = 0.1 }");
    carries(2.5, 4, "{ vx = 0.1 }");
    CHECK(pass().empty());
    it.network->says = Expected<PlainData>(failure("host ev3 has not answered"));
    CHECK(pass().empty());  // it may come back
    carries(3.5, 9, "{ vx = 0.2 }");
    CHECK(pass() == "[3.500] ev3/vehicle.current_vel = { vx = 0.2 }");
    CHECK(it.type("unwatch('ev3/vehicle.current_vel')").empty());
    CHECK(it.type("watch('ev3/vehicle.curent_vel')") ==
          "! watch: host ev3 has no port vehicle.curent_vel (did you mean 'vehicle.current_vel'?)");
    CHECK(it.type("watch('ev4/vehicle.current_vel')") == "! watch: there is no host 'ev4' (did you mean 'ev3'?)");
}

TEST_CASE("a port of another host that is not connected here is plotted, with its past", "[console][network]") {
    HostsRig it;
    RecentCurves recent{.first = 60, .now = 100};
    for (int i = 0; i < 100; ++i) recent.curves.resize(1), recent.curves[0].points.emplace_back(99 + i * 0.01, i);
    recent.curves[0].name = "vx";
    it.network->says = to_plain(recent);
    const std::string drawn = it.type("plot('ev3/vehicle.current_vel.vx', 1)");
    CHECK(drawn.find("ev3/vehicle.current_vel.vx\nvx\n") == 0);
    CHECK(drawn.find("99 ") != std::string::npos);
    REQUIRE(it.network->asked.size() == 1);
    CHECK(it.network->asked[0].component == "vehicle");
    CHECK(it.network->asked[0].name == "current_vel.vx");
    CHECK(it.network->asked[0].values.values == std::vector<Value>{1.0});
    SECTION("again and again") {
        it.type("plot('ev3/vehicle.current_vel', 1, { every = 0.1 })");
        it.shown.clear();
        for (int i = 0; i < 12; ++i) it.live->tick(), it.session->after_tick();
        CHECK(it.shown.find("ev3/vehicle.current_vel\n") == 0);
        it.network->says = Expected<PlainData>(failure("host ev3: there is no component 'vehicle'"));
        it.shown.clear();
        for (int i = 0; i < 12; ++i) it.live->tick(), it.session->after_tick();
        CHECK(it.shown == "host ev3: there is no component 'vehicle': no longer drawn");
    }
    SECTION("an answer that is malformed is an error") {
        it.network->says = PlainData{.values = {1.0, 2.0, std::string("vx")}, .tables = {}};
        CHECK(it.type("plot('ev3/vehicle.current_vel')") == "! plot: malformed curves");
    }
}

TEST_CASE("ports of two other hosts are connected from here", "[console][network]") {
    HostsRig it;
    it.network->says = PlainData{};
    CHECK(it.type("connect('pi2/driver.out', 'ev3/vehicle.velocity2D')").empty());
    CHECK(it.type("disconnect('pi2/driver.out', 'ev3/vehicle.velocity2D')").empty());
    REQUIRE(it.network->asked.size() == 2);
    const Question& asked = it.network->asked[0];
    CHECK(asked.what == Question::What::connect);
    CHECK(asked.host + " " + asked.component + " " + asked.name == "ev3 vehicle velocity2D");
    CHECK(asked.values.values == std::vector<Value>{std::string("pi2/driver.out")});
    CHECK(it.network->asked[1].what == Question::What::disconnect);
    it.network->says = Expected<PlainData>(failure("host ev3: there is no component 'vehicel'"));
    CHECK(it.type("connect('pi2/driver.out', 'ev3/vehicel.velocity2D')") ==
          "! connect: host ev3: there is no component 'vehicel'");
}

TEST_CASE("ticks go on while another host is waited for, and the wait can be interrupted", "[console][network]") {
    HostsRig it;
    it.session->submit("hosts.ev3.vehicle:use 'careful'");
    while (it.network->asked.empty()) it.session->advance();
    for (int i = 0; i < 5; ++i) {
        it.session->advance();
        it.live->tick();
    }
    CHECK(it.session->is_busy());
    REQUIRE(it.network->asked.size() == 1);
    CHECK(it.network->asked[0].what == Question::What::use);
    CHECK(it.network->asked[0].name == "careful");
    SECTION("until it answers") {
        PlainData set;
        set.values.emplace_back(std::string("careful"));
        it.network->says = set;
        while (it.session->is_busy()) it.session->advance();
        CHECK(it.shown == "\"careful\"");
    }
    SECTION("or refuses") {
        it.network->says = Expected<PlainData>(failure("host ev3: vehicle has no set 'careful'"));
        while (it.session->is_busy()) it.session->advance();
        CHECK(it.shown == "! host ev3: vehicle has no set 'careful'");
    }
    SECTION("or Ctrl-C comes") {
        it.session->interrupt();
        CHECK_FALSE(it.session->is_busy());
        CHECK(it.shown == "! interrupted");
    }
}

TEST_CASE("a component of another host is shown, completed, explained and plotted as at its own console",
          "[console][network]") {
    HostsRig ev3(R"(
local out = output("out", "TimedVelocity2D", "its velocity")
local input_ = input("in", "TimedShortSeq")
param("speed", 0.5, { min = 0, max = 1, unit = "m/s", doc = "how fast" })
param("gains", { 1.0, 0.5 })
state.list = { 1, { deep = true } }
command("calibrate", function(n) return n * 2 end, "measures")
function on_execute()
  probe("seen", { left = 1, right = 2.5 })
  out:write { vx = config.speed, va = -1 }
end
)",
                 "network { name = 'ev3' }\nbehavior 'c' { script = 'it', sets = { slow = { speed = 0.1 } } }\n");
    HostsRig pi;
    pi.network->system = ev3.live.get();
    ev3.live->activate();
    for (int i = 0; i < 20; ++i) ev3.live->tick();
    const TreeNode component = *ev3.live->tree().child("c");
    for (const std::string& name : component.children(TreeNode::Called::no)) {
        if (name == "name" || name == "in") continue;  // which Lua can't write so
        CAPTURE(name);
        const bool is_port = component.child(name)->kind() == TreeNode::Kind::port;
        CHECK(pi.type("hosts.ev3.c." + name) == (is_port ? "ev3/" : "") + ev3.type("c." + name));
    }
    for (const std::string& name : component.child("out")->children(TreeNode::Called::no)) {
        CAPTURE(name);
        CHECK(pi.type("hosts.ev3.c.out." + name) == ev3.type("c.out." + name));
    }
    CHECK(pi.type("hosts.ev3.c") == "ev3/" + ev3.type("c"));
    CHECK(pi.type("hosts.ev3.c.name") == "\"ev3/c\"");
    CHECK(pi.type("hosts.ev3.c.out.value.vx") == "0.5");
    CHECK(pi.type("hosts.ev3.c.state.list[2].deep") == "true");
    CHECK(pi.type("for k in pairs(hosts.ev3.c.ports) do print(k) end") == "inout");
    for (const std::string text : {"c.", "c:", "c.config.", "c.out.", "c.out:", "plot(c.out."}) {
        CAPTURE(text);
        const std::size_t at = text.find("c.") == std::string::npos ? text.find("c:") : text.find("c.");
        CHECK(pi.complete(text.substr(0, at) + "hosts.ev3." + text.substr(at)) == ev3.complete(text));
    }
    for (const std::string text : {"c", "c.out", "c.config"})
        CHECK(pi.type("help(hosts.ev3." + text + ")") == ev3.type("help(" + text + ")"));
    CHECK(pi.type("plot(hosts.ev3.c.out.vx, 1)").find("the only value that is remembered") != std::string::npos);
    for (int i = 0; i < 20; ++i) ev3.live->tick();
    CHECK(pi.type("plot(hosts.ev3.c.out.vx, 1)") == "ev3/c.out.vx\nvx = 0.5 all the time");
    CHECK(pi.type("hosts.ev3.c:calibrate(3)") == "6");
    CHECK(pi.type("hosts.ev3.c.config.speed = 0.25").empty());
    CHECK(ev3.type("c.config.speed") == "0.25");
    CHECK(pi.type("hosts.ev3.c.config.sped") == "! c: unknown parameter 'sped' (did you mean 'speed'?)");
    CHECK(pi.type("hosts.ev3.c.stat") == "! c has no 'stat' (did you mean 'state'?)");
    CHECK(pi.type("hosts.ev3.c.out:write { vx = 1 }") == "! ev3/c.out:write: this can be done only on its own host");
}

TEST_CASE("a wrong use of another host's component is reported", "[console][network]") {
    HostsRig it;
    CHECK(it.type("hosts.ev4") == "! there is no host 'ev4' (did you mean 'ev3'?)");
    it.network->says = PlainData{.values = {1.0}, .tables = {}};
    CHECK(it.type("hosts.ev3.vehicle.status") == "! malformed snapshot");
    CHECK(it.type("hosts.ev3.vehicle.activate()") ==
          "! activate: write `X:activate(...)` with a colon, not `X.activate(...)`");
    CHECK(it.type("hosts.ev3.vehicle.speed = 1").find("parameters can, as in X.config.NAME = value") !=
          std::string::npos);
    CHECK(it.type("hosts = 1") == "! 'hosts' is a command of the console: choose another name");
}

TEST_CASE("values of another host are read-only copies", "[console][network]") {
    HostsRig it;
    HostsRig ev3("param('gains', { 1.5 })\n",
                 "network { name = 'ev3' }\nbehavior 'vehicle' { script = 'it', sets = { careful = {} } }\n");
    it.network->system = ev3.live.get();
    const std::string says =
        "! can't set 'hosts.ev3.vehicle.config.gains[1]': 'hosts.ev3.vehicle.config.gains' is a copy: write the whole "
        "value: "
        "hosts.ev3.vehicle.config.gains = { ... }";
    CHECK(it.type("hosts.ev3.vehicle.config.gains[1]") == "1.5");
    CHECK(it.type("hosts.ev3.vehicle.config.gains[1] = 3") == says);
    CHECK(it.type("for _, value in pairs(hosts.ev3.vehicle.config) do value[1] = 3 end") == says);
    CHECK(it.type("hosts.ev3.vehicle.sets[1] = 'x'") ==
          "! can't set 'hosts.ev3.vehicle.sets[1]': 'hosts.ev3.vehicle.sets' is a copy: set them in the system file");
    CHECK(it.type("hosts.ev3.vehicle.ports.x = 1").find("parameters can, as in X.config.NAME = value") !=
          std::string::npos);
}
