// Robots that see and hear each other: the same run with any number of threads, after going back, and after changes.
#include <catch2/catch.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/unit/live_rig.hpp"

using namespace nezumi;

namespace {

const std::string talker_behavior = R"(
local near = input("near", "NeighbourSeq", "the robots in sight")
local say = output("say", "TimedDoubleSeq", "a number that depends on all it has heard")
local lamps = output("lamps", "TimedBooleanSeq", "the number in lights")
local target = output("target", "TimedVelocity2D", "velocity")
state.heard = 0
function on_execute()
  for i, other in ipairs(near:read()) do
    state.heard = state.heard + (other.message[1] or 1) / i + other.range + other.bearing
    if other.leds[2] then state.heard = state.heard + 0.3 end
  end
  state.heard = state.heard % 6
  say:write { state.heard, now() }
  lamps:write { state.heard > 1, state.heard > 2, state.heard > 3, state.heard > 4 }
  target:write { vx = 0.1, va = state.heard - 3 }
end
)";

// `ring`: all are connected, so that threads share the robots of one group.
std::string talkers(bool ring) {
    return R"(
for i = 1, 40 do
  robot("r" .. i, {
    model = "raspimouse",
    pose = { x = 0.2 * (i % 7), y = 0.2 * (i // 7), heading = i },
    sensors = { near = { kind = "neighbours", radius = 0.5, noise = 0.01, bearing_noise = 0.1, loss = 0.2 } },
    ports = { near = { type = "NeighbourSeq", from = "near" }, say = { type = "TimedDoubleSeq", to = "say" } },
  })
  behavior("b" .. i, { script = "talker" })
  connect("r" .. i .. ".near", "b" .. i .. ".near")
  connect("b" .. i .. ".say", "r" .. i .. ".say")
  connect("b" .. i .. ".lamps", "r" .. i .. ".led4bit_in")
  connect("b" .. i .. ".target", "r" .. i .. ".target_velocity_in")
end
)" + std::string(ring ? "for i = 2, 40 do connect('b' .. i - 1 .. '.lamps', 'r' .. i .. '.led4bit_in') end\n" : "");
}

struct Talkers : LiveRig {
    explicit Talkers(int threads = 1, bool ring = false)
        : LiveRig(talkers(ring), {{"talker", talker_behavior}}, disk(), with_threads(threads)) {}

    static BuildOptions with_threads(int threads) {
        BuildOptions build;
        build.threads = threads;
        return build;
    }
    std::vector<Neighbour> seen_by(const std::string& robot) const {
        const OutPortBase* port = live->system().find(robot)->find_out_port("near");
        return static_cast<const OutPort<std::vector<Neighbour>>*>(port)->read();
    }
    bool sees(const std::string& robot, const std::string& other) const {
        for (const Neighbour& each : seen_by(robot)) {
            if (each.name == other) return true;
        }
        return false;
    }
    void act(const Act& act) {
        const auto done = live->act(act, {});
        INFO((done ? "" : describe(done.error())));
        REQUIRE(done);
    }
};

const std::string pair_system = R"(
local near = { kind = "neighbours", radius = 1 }
local ports = { near = { type = "NeighbourSeq", from = "near" }, say = { type = "TimedDoubleSeq", to = "say" } }
robot "a" { model = "raspimouse", pose = { x = 0, y = 0 }, sensors = { near = near }, ports = ports }
robot "b" { model = "raspimouse", pose = { x = 0.3, y = 0 }, sensors = { near = near }, ports = ports }
)";

}  // namespace

TEST_CASE("robots that talk have the same run with any number of threads", "[lua][neighbours]") {
    const bool ring = GENERATE(false, true);
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 2, 3, 4}) {
        Talkers it(threads, ring);
        it.tick(150);
        hashes.push_back(it.live->trace_hash());
        if (threads == 1) {
            CHECK(it.seen_by("r10").size() > 2);
            CHECK(it.seen_by("r10").front().message.size() == 2);
            CHECK(it.seen_by("r10").front().leds.size() == 4);
        }
    }
    for (const std::uint64_t hash : hashes) CHECK(hash == hashes.front());
}

TEST_CASE("what robots say and what of it is lost come again after a seek and a restart", "[lua][neighbours]") {
    Talkers it;
    std::vector<std::uint64_t> hashes;
    std::vector<Neighbour> seen;
    for (int i = 0; i < 120; ++i) {
        if (i == 40) {
            seen = it.seen_by("r10");
            it.act(Remove{"r11"});
        }
        if (i == 70) it.act(Teleport{"r40", {{3, 3}, 0}});
        it.tick();
        hashes.push_back(it.live->trace_hash());
    }
    for (const int tick : {35, 55, 100}) {
        INFO(tick);
        it.act(Seek{.tick = tick});
        CHECK(it.live->trace_hash() == hashes[static_cast<std::size_t>(tick - 1)]);
        it.tick(120 - tick);
        CHECK(it.live->trace_hash() == hashes.back());
    }
    it.act(Restart{});
    it.tick(40);
    CHECK(seen.size() > 2);
    CHECK(it.seen_by("r10") == seen);
}

TEST_CASE("a robot that is removed or moved away is not seen, and one that is back is", "[lua][neighbours]") {
    Talkers it;
    const auto soon_sees = [&](const std::string& robot, const std::string& other) {
        bool seen = false;
        for (int i = 0; i < 30; ++i) {  // one look in five misses it
            it.tick();
            seen = seen || it.sees(robot, other);
        }
        return seen;
    };
    REQUIRE(soon_sees("r10", "r11"));
    it.act(Teleport{"r11", {{3, 3}, 0}});
    it.tick();
    CHECK_FALSE(soon_sees("r10", "r11"));
    it.act(Teleport{"r11", {{it.live->system().world()->truth(9).pose.position.x, 1.4}, 0}});
    it.act(Teleport{"r10", {{it.live->system().world()->truth(9).pose.position.x, 1.6}, 0}});
    CHECK(soon_sees("r10", "r11"));
    it.act(Remove{"r11"});
    it.tick();
    CHECK_FALSE(soon_sees("r10", "r11"));
    CHECK_FALSE(it.live->system().fatal_error());
}

TEST_CASE("a robot that is not active says nothing", "[lua][neighbours]") {
    LiveRig it(pair_system, {});
    const auto heard = [&] {
        const OutPortBase* port = it.live->system().find("a")->find_out_port("near");
        return static_cast<const OutPort<std::vector<Neighbour>>*>(port)->read().front().message;
    };
    REQUIRE(it.live->act(Inject{"b.say", Value(std::vector<double>{1, 2})}, {}));
    it.tick(5);
    CHECK(heard() == std::vector<double>{1, 2});
    REQUIRE(it.live->act(Deactivate{"b"}, {}));
    it.tick(3);
    CHECK(heard().empty());
    REQUIRE(it.live->act(Activate{"b"}, {}));
    it.tick(3);
    CHECK(heard().empty());
}

TEST_CASE("of a message with more than ten numbers the first ten are sent, and the log says so", "[lua][neighbours]") {
    LiveRig it(pair_system, {});
    REQUIRE(it.live->act(Inject{"b.say", Value(std::vector<double>(12, 7.0))}, {}));
    it.tick(5);
    const OutPortBase* port = it.live->system().find("a")->find_out_port("near");
    const auto seen = static_cast<const OutPort<std::vector<Neighbour>>*>(port)->read();
    CHECK(seen.front().message == std::vector<double>(10, 7.0));
    CHECK(it.said("input 'say' got 12 numbers, and a robot can say only 10: the others are not sent (reported once)"));
}

namespace {

// `speaker` drives b's message, `listener` hears what a sees.
struct Speakers : LiveRig {
    static std::string system(const std::string& say) {
        return R"(
local near = { kind = "neighbours", radius = 1 }
local ports = {
  near = { type = "NeighbourSeq", from = "near" },
  say = { type = "TimedDoubleSeq", to = "say")" +
               say + R"( },
}
robot "a" { model = "raspimouse", pose = { x = 0, y = 0 }, sensors = { near = near }, ports = ports }
robot "b" { model = "raspimouse", pose = { x = 0.3, y = 0 }, sensors = { near = near }, ports = ports }
behavior "listener" { script = "listener" }
behavior "speaker" { script = "speaker" }
connect("a.near", "listener.near")
connect("speaker.say", "b.say")
)";
    }
    static inline const std::string says = "local say = output('say', 'TimedDoubleSeq') ";
    static std::string listens(const std::string& options, const std::string& on_execute) {
        return "local near = input('near', 'NeighbourSeq'" + options +
               ") local heard = output('heard', 'TimedDoubleSeq') " + on_execute;
    }
    explicit Speakers(const std::string& say = "",
                      const std::string& listener = listens("", "function on_execute() end"))
        : LiveRig(system(say),
                  {{"speaker", says + "function on_execute() say:write { 1, now() } end"}, {"listener", listener}}) {}

    Reload saved(const std::string& script, const std::string& text) const {
        return {.files = {folder.write("behaviors/" + script + ".lua", text).string()}};
    }
    void reload(const std::string& script, const std::string& text) {
        const auto done = live->act(saved(script, text), {});
        INFO((done ? "" : describe(done.error())));
        REQUIRE(done);
    }
    std::vector<double> heard() const {
        const OutPortBase* port = live->system().find("a")->find_out_port("near");
        const auto seen = static_cast<const OutPort<std::vector<Neighbour>>*>(port)->read();
        REQUIRE(seen.size() == 1);
        return seen.front().message;
    }
};

}  // namespace

TEST_CASE("a message of an old version holds until the new version says something else", "[lua][neighbours][reload]") {
    Speakers it;
    it.tick(10);
    const std::vector<double> last = it.heard();
    REQUIRE(last.size() == 2);
    it.reload("speaker", Speakers::says + "function on_execute() if now() > 0.5 then say:write { 2 } end end");
    it.tick(3);
    const std::vector<double> held = it.heard();
    CHECK(held.at(1) == Approx(last.at(1) + 0.01));  // of its last execution
    it.tick(30);
    CHECK(it.heard() == held);
    it.tick(20);
    CHECK(it.heard() == std::vector<double>{2});
}

TEST_CASE("a robot whose port says so is silent half a second after a new version says nothing",
          "[lua][neighbours][reload]") {
    Speakers it(", silence = 'off'");
    it.tick(10);
    it.reload("speaker", Speakers::says + "function on_execute() end");
    it.tick(40);
    CHECK(it.heard().size() == 2);
    it.tick(20);
    CHECK(it.heard().empty());
    it.reload("speaker", Speakers::says + "function on_execute() say:write { 3 } end");
    it.tick(3);
    CHECK(it.heard() == std::vector<double>{3});
}

TEST_CASE(
    "a version that fails in its first execution does not change what its robot says, and ERROR keeps the last message",
    "[lua][neighbours][reload]") {
    Speakers it;
    it.tick(10);
    CHECK_FALSE(it.live->act(it.saved("speaker", "function"), {}));
    it.tick(10);
    CHECK(it.heard().at(1) == Approx(0.18));
    it.reload("speaker", Speakers::says + "function on_execute() error('no luck') end");
    it.tick(10);
    CHECK(it.said("no luck"));
    CHECK(it.heard().at(1) == Approx(0.28));
    it.reload("speaker",
              Speakers::says + "function on_execute() if now() > 0.5 then error('too late') end say:write { 7 } end");
    it.tick(40);
    CHECK(it.component("speaker").state() == LifeState::error);
    CHECK(it.heard() == std::vector<double>{7});
}

TEST_CASE("the next version reads messages that were not read yet, the oldest first", "[lua][neighbours][reload]") {
    const auto listener = [](const std::string& body) {
        return Speakers::listens(", { queue = 4 }", "function on_execute() " + body + " end");
    };
    Speakers it("", listener(""));
    it.tick(20);
    it.reload("listener", listener("local all = {} while near.is_new do all[#all + 1] = near:read()[1].message[2] end "
                                   "heard:write(all)"));
    it.tick();
    const OutPortBase* port = it.live->system().find("listener")->find_out_port("heard");
    const std::vector<double> times = static_cast<const OutPort<std::vector<double>>*>(port)->read();
    // Four were kept, of which the arrival of this tick pushed out the oldest.
    REQUIRE(times.size() == 4);
    for (std::size_t i = 1; i < times.size(); ++i) CHECK(times[i] - times[i - 1] == Approx(0.01));
    CHECK(times.back() == Approx(0.19));
}
