// The one door through which a running system is changed, and what goes with it.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "engine/ports/payload.hpp"
#include "engine/robot/robot.hpp"
#include "tests/unit/live_rig.hpp"

using namespace nezumi;

namespace {

const Actor gamepad{Actor::Kind::joystick, "pad"};

Velocity2D sent(const LiveRig& it) { return (*it.live->system().port("controller.out"))->value().get<Velocity2D>(); }

}  // namespace

TEST_CASE("the holds of an actor that is gone end, a velocity with zero first", "[lua][act]") {
    LiveRig it;
    REQUIRE(it.live->act(Hold{"controller.out", Velocity2D{.vx = 0.1}}, gamepad));
    REQUIRE(it.live->act(Hold{"controller.in", std::vector<std::int16_t>{31}}, gamepad));
    REQUIRE(it.live->act(Hold{"mouse.target_velocity_in", Velocity2D{.vx = 0.2}}, {Actor::Kind::console}));
    it.tick(3);
    CHECK(sent(it).vx == 0.1);
    it.live->let_go(gamepad);
    CHECK(it.live->system().holder("controller.in") == nullptr);
    it.tick();
    CHECK(sent(it) == Velocity2D{});
    CHECK(it.live->system().holder("controller.out") != nullptr);
    it.tick();
    CHECK(it.live->system().holder("controller.out") == nullptr);
    it.tick();
    CHECK(sent(it).vx == 0.25);  // its component's own again
    CHECK(it.live->system().holder("mouse.target_velocity_in") != nullptr);
}

TEST_CASE("the hash after a restart includes the starts before", "[lua][act]") {
    LiveRig it;
    it.tick(20);
    const std::uint64_t first = it.live->trace_hash();
    REQUIRE(it.live->act(Restart{}, {}));
    it.tick(20);
    CHECK(it.live->trace_hash() == mix(first, first));
    CHECK(it.live->starts() == 2);
}

TEST_CASE("an emergency stop continues after a restart, which is reported, and rearm() works at once", "[lua][act]") {
    LiveRig it;
    it.tick(30);
    REQUIRE(it.live->act(Stop{}, {}));
    it.tick(50);
    const auto speed = [&] { return dynamic_cast<const Robot&>(it.component("mouse")).measured().vx; };
    for (int start = 2; start < 4; ++start) {
        it.log.clear();
        REQUIRE(it.live->act(Restart{}, {}));
        CHECK(it.live->system().is_stopped());
        it.tick(50);
        CHECK(sent(it).vx == 0.25);
        CHECK(std::abs(speed()) < 0.001);
        CHECK(std::count_if(it.log.begin(), it.log.end(), [](const LogLine& line) {
                  return line.text == "the emergency stop is still active: rearm() lets the robots drive again";
              }) == 1);
    }
    REQUIRE(it.live->act(Restart{}, {}));
    REQUIRE(it.live->act(Rearm{}, {}));
    it.tick(50);
    CHECK(speed() > 0.1);
    it.log.clear();
    REQUIRE(it.live->act(Restart{}, {}));
    CHECK_FALSE(it.live->system().is_stopped());
    CHECK_FALSE(it.said("the emergency stop is still active"));
}

TEST_CASE("a refused act changes nothing and gives the reason", "[lua][act]") {
    LiveRig it;
    const auto error = [&](const Act& act) {
        const auto done = it.live->act(act, {});
        return done ? "" : done.error().message;
    };
    CHECK(error(Reload{.component = "mouse", .text = "x"}) == "mouse has no script: only behaviours can be reloaded");
    CHECK(error(Rollback{"controller"}) == "controller has no version before this one; still running version 1");
    CHECK(error(Remove{"contoller"}) == "there is no component 'contoller' (did you mean 'controller'?)");
    CHECK(error(SetParameter{"controller", "speed_x", 2.0}) ==
          "parameter 'speed_x' (number): 2.0 is above its maximum 1.5");
    it.folder.write("system.lua", "robot(");
    CHECK_FALSE(it.live->act(Restart{}, {}));
    CHECK(it.live->starts() == 1);
}

TEST_CASE("a removed component is also removed from the description", "[lua][act]") {
    LiveRig it;
    REQUIRE(it.live->act(Remove{"controller"}, {}));
    CHECK(it.live->system().find("controller") == nullptr);
    CHECK(it.live->spec().entries.size() == 1);
    it.tick(3);
}

TEST_CASE("the trace continues when components are added and removed", "[lua][act]") {
    LiveRig it;
    const auto error = [&](const Act& act) {
        const auto done = it.live->act(act, {});
        return done ? "" : done.error().message;
    };
    it.tick(3);
    BehaviorEntry second{.name = "second", .script = "counter"};
    second.path = it.folder.path("behaviors/counter.lua").string();
    REQUIRE(it.live->act(Add{second}, {}));
    REQUIRE(it.live->act(Activate{"second"}, {}));
    const auto followed = it.live->trace().follow("second.out");
    REQUIRE(followed);
    it.tick(3);
    CHECK((*followed)->exists());
    REQUIRE(it.live->act(Remove{"second"}, {}));
    it.tick(3);
    CHECK_FALSE((*followed)->exists());
    REQUIRE(it.live->act(Add{second}, {}));
    it.tick();
    CHECK((*followed)->exists());  // the same channel, by its name
    CHECK(error(AddMarker{{.name = "m", .id = 1, .size = -1}}) ==
          "marker: field 'size' expected a positive number, got -1");
    CHECK(error(RemoveMarker{"m"}) == "there is no marker 'm'");
}

TEST_CASE("a run with added and removed components has the same hash each time", "[lua][act]") {
    const auto hash = [] {
        LiveRig it;
        it.tick(5);
        BehaviorEntry second{.name = "second", .script = "counter"};
        second.path = it.folder.path("behaviors/counter.lua").string();
        REQUIRE(it.live->act(Add{second}, {}));
        REQUIRE(it.live->act(Activate{"second"}, {}));
        it.tick(5);
        REQUIRE(it.live->act(Remove{"controller"}, {}));
        it.tick(5);
        return it.live->trace_hash();
    };
    CHECK(hash() == hash());
}
