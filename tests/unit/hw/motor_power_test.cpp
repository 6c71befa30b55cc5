// The power of the mouse's motors: when it is switched, and what happens if that fails.
#include <catch2/catch.hpp>

#include "hw/raspimouse/motors.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

TEST_CASE("after a long standstill motors have no power until they must turn again",
          "[hw][mouse][fakes][safety][wallclock]") {
    constexpr double standing_power = 0.5;  // [s]
    constexpr double metres_per_pulse = 2 * 3.14159265 * 0.024 / 400;
    FakeMouse fake;
    auto made = Motors::make(fake.dev(), {.left = metres_per_pulse, .right = metres_per_pulse}, 0.52, standing_power);
    REQUIRE(made);
    const RunningJob motors(std::move(*made));
    // Like a control loop, for some seconds or until a condition is true; returns the time taken.
    const auto command = [&](double speed, double seconds, const std::function<bool(FakeMouse::Motion)>& until) {
        const double begin = clock_seconds();
        while (clock_seconds() - begin < seconds) {
            motors->command({.power = true, .speeds = {.left = speed, .right = speed}});
            motors.wake();
            sleep_for(0.01);
            if (until && until(fake.motion())) return clock_seconds() - begin;
        }
        return seconds;
    };
    const auto has_power = [](const FakeMouse::Motion& is) { return is.power; };
    const auto has_none = [](const FakeMouse::Motion& is) { return !is.power; };
    const auto turns = [](const FakeMouse::Motion& is) { return is.left > 150 && is.power; };

    CHECK(command(0, 2, has_power) < 2);  // the control loop's first command
    const double stood = command(0, 3, has_none);
    CHECK(stood > standing_power - 0.2);
    CHECK(stood < standing_power + 0.5);
    command(0, 0.3, nullptr);
    CHECK_FALSE(fake.motion().power);

    CHECK(command(0.1, 2, turns) < 2);
    command(0.1, 2 * standing_power, nullptr);  // in motion the power stays on
    CHECK(fake.motion().power);
    CHECK(command(0, 3, has_none) > standing_power - 0.2);
    CHECK(command(-0.1, 2, [](const auto& is) { return is.left < -150 && is.power; }) < 2);
    CHECK(motors->take_faults().empty());
}

TEST_CASE("motors whose power can't be switched off stand, and give no other message until they work again",
          "[hw][mouse][fakes][safety][wallclock]") {
    FakeMouse fake;
    DrivenMouse mouse(fake);
    REQUIRE(mouse.run(3, {.vx = 0.1}, [&] { return fake.motion().left > 200; }));
    fake.fault("rtmotoren0", "eio");
    REQUIRE(mouse.robot->deactivate(mouse.system.now()));
    mouse.run(2);
    CHECK(fake.motion().left == 0);
    CHECK(fake.motion().right == 0);
    CHECK(mouse.log == std::vector<std::string>{
                           "motors: " + fake.dev() +
                           "/rtmotoren0: input/output error: look at the robot's power and cables, and at what dmesg "
                           "says"});
    REQUIRE(mouse.robot->activate(mouse.system.now()));
    mouse.run(1, {.vx = 0.1});
    CHECK(fake.motion().left == 0);
    fake.fault("rtmotoren0", "none");
    CHECK(mouse.run(3, {.vx = 0.1}, [&] { return fake.motion().left > 200; }));
    CHECK(mouse.run(3, {.vx = 0.1}, [&] { return mouse.said("motors: back again"); }));
}
