// Other hosts at the console: their components and ports by name, and the wait for what they answer.
#include <catch2/catch.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/console/session.hpp"
#include "bindings/console/worker.hpp"
#include "bindings/lua/reload/lua_host.hpp"
#include "engine/live/running_system.hpp"
#include "engine/system/network.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

using Lines = std::vector<std::string>;

// Another host, ev3, that answers what a test says, or nothing.
class OneHost final : public Network {
public:
    Expected<void> reach(std::string_view /*path*/, const Port& /*other*/) override { return failure("not here"); }
    void between_ticks(const ActDoor& /*act*/) override {}
    void before_tick(const MessageDoor& /*deliver*/) override {}
    std::vector<Host> hosts() const override {
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
    std::optional<Expected<PlainData>> answer(std::uint64_t /*number*/) const override { return says; }

    mutable std::vector<Question> asked;
    std::optional<Expected<PlainData>> says;
};

struct HostsRig : ClockControl {
    HostsRig() {
        folder.write("behaviors/it.lua", "local out = output('out', 'TimedVelocity2D')\n");
        LiveOptions options;
        options.scripts = &lua_scripts();
        options.installed = {source_root()};
        options.network = [this](const SystemSpec&, System&) -> Expected<std::unique_ptr<Network>> {
            auto made = std::make_unique<OneHost>();
            network = made.get();
            return made;
        };
        auto loaded = RunningSystem::load(
            folder.write("s.lua", "network { name = 'pi' }\nbehavior 'it' { script = 'it' }\n"), std::move(options));
        REQUIRE(loaded.has_value());
        live = std::move(*loaded);
        SessionOptions session_options;
        session_options.bell = &bell;
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
    CHECK(it.complete("hosts.ev3.vehicle.v") == Lines{"velocity2D", "version"});
    CHECK(it.complete("hosts.ev3.vehicle:") == Lines{"activate", "deactivate", "reset", "use"});
    CHECK(it.complete("connect('ev3/") == Lines{"ev3/vehicle.current_vel"});
    CHECK(it.complete("connect('it.out', 'ev3/") == Lines{"ev3/vehicle.velocity2D"});
    CHECK(it.type("hosts") == "ev3: driver, vehicle");
    CHECK(it.type("hosts.ev3.vehicle.current_vel") == "\"ev3/vehicle.current_vel\"");
    CHECK(it.network->asked.empty());
}

TEST_CASE("ports of other hosts are connected by their names", "[console][network]") {
    HostsRig it;
    CHECK(it.type("connect('it.out', 'ev3/vehicle.velocity2D')") == "! connect: not here");  // the network was asked
    CHECK(it.type("connect('ev3/vehicle.current_vel', 'it.out')") == "! connect: not here");
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

TEST_CASE("what can be no member of a component of another host is told", "[console][network]") {
    HostsRig it;
    CHECK(it.type("hosts.ev4") == "! there is no host 'ev4' (did you mean 'ev3'?)");
    CHECK(it.type("hosts.ev3.vehicle.truth") == "! ev3/vehicle has no 'truth' over the network");
    CHECK(it.type("hosts.ev3.vehicle.activate()") ==
          "! activate: write `X:activate(...)` with a colon, not `X.activate(...)`");
    CHECK(it.type("hosts.ev3.vehicle.speed = 1").find("parameters can, as in X.config.NAME = value") !=
          std::string::npos);
    CHECK(it.type("hosts = 1") == "! 'hosts' is a word of the console: choose another name");
}

TEST_CASE("what another host shows is a copy that can't be written", "[console][network]") {
    HostsRig it;
    using Ref = TableRef;
    PlainData look;
    look.values.emplace_back(Ref{0});
    look.tables = {{{std::string("config"), Ref{1}}, {std::string("sets"), Ref{3}}},
                   {{std::string("gains"), Ref{2}}},
                   {{std::int64_t{1}, 1.5}},
                   {{std::int64_t{1}, std::string("careful")}}};
    it.network->says = look;
    const std::string says =
        "! can't set 'hosts.ev3.vehicle.config.gains[1]': 'hosts.ev3.vehicle.config.gains' is a copy: write all of it, "
        "hosts.ev3.vehicle.config.gains = { ... }";
    CHECK(it.type("hosts.ev3.vehicle.config.gains[1]") == "1.5");
    CHECK(it.type("hosts.ev3.vehicle.config.gains[1] = 3") == says);
    CHECK(it.type("for _, value in pairs(hosts.ev3.vehicle.config) do value[1] = 3 end") == says);
    CHECK(it.type("hosts.ev3.vehicle.sets[1] = 'x'") ==
          "! can't set 'hosts.ev3.vehicle.sets[1]': 'hosts.ev3.vehicle.sets' is a copy: the system file says them");
    CHECK(it.type("hosts.ev3.vehicle.ports[1] = 'x'") ==
          "! can't set 'hosts.ev3.vehicle.ports[1]': 'hosts.ev3.vehicle.ports' is a copy");
}
