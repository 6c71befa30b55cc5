// The power of the mouse's motors: when it goes, when it comes back, and when it can't be cut.
#include <catch2/catch.hpp>

#include "hw/raspimouse/motors.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

TEST_CASE("motors whose power can't be cut stand, and nothing else is told of them until they are well again",
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
