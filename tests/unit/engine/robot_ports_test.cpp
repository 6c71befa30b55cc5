// What a robot's ports do with its actuators, and which can't be.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/engine/fake_world.hpp"

using namespace nezumi;

TEST_CASE("actuators stay within their limits", "[engine][robot]") {
    FakeRun run;
    run.send("buzzer_in", std::int16_t{-5});
    CHECK(run.hull().hertz == 0);
    run.send("neck_in", 3.0);
    CHECK(run.hull().servos[2] == 1.0);
    run.send("neck_in", std::nan(""));
    CHECK(run.hull().servos[2] == 1.0);
    // A sequence of another length sets as many lights as it has.
    run.send("leds_in", std::vector<bool>{true, true, true, true, true});
    run.send("leds_in", std::vector<bool>{false});
    run.send("leds_in", std::vector<bool>{});
    CHECK(run.robot->leds() == std::vector<bool>{false, true, true, true});
    CHECK(run.hull().led_calls == 2);
}

TEST_CASE("a description with an impossible port is refused with the port's name", "[engine][robot]") {
    const auto refusal = [](const auto& spoil) {
        RobotSpec spec = fake_mouse();
        PortSpec port;
        port.name = "extra";
        port.is_input = true;
        spoil(port);
        spec.ports.push_back(port);
        spec.place = {"robot.lua"};
        const auto made = Robot::make("mouse", spec, spec.drive.limits);
        return made ? "" : describe(made.error());
    };
    CHECK(refusal([](PortSpec& p) { p.items = {}; }) == "robot.lua: port 'extra': has no `from` and no `to`");
    CHECK(refusal([](PortSpec& p) { p.items = {"drive"}, p.type = "TimedDouble"; }) ==
          "robot.lua: port 'extra': 'drive' takes a TimedVelocity2D, not a TimedDouble");
    CHECK(refusal([](PortSpec& p) { p.items = {"drive"}, p.type = "TimedVelocity2D"; }) ==
          "robot.lua: port 'extra': a robot can have only one in-port for its drive");
    CHECK(refusal([](PortSpec& p) { p.items = {"neck"}, p.type = "TimedDouble"; }) ==
          "robot.lua: port 'extra': actuator 'neck' has the in-port 'neck_in' already");
    CHECK(refusal([](PortSpec& p) { p.items = {"bozzer"}, p.type = "TimedShort"; }) ==
          "robot.lua: port 'extra': there is no actuator 'bozzer' (did you mean 'buzzer'?)");
    const auto out = [](const char* type, const std::vector<std::string>& items) {
        return [=](PortSpec& p) { p.is_input = false, p.type = type, p.items = items; };
    };
    CHECK(refusal(out("TimedDoubel", {"gyro"})).find("(did you mean 'TimedDouble'?)") != std::string::npos);
    CHECK(refusal(out("TimedDouble", {"gyros"})) ==
          "robot.lua: port 'extra': there is no sensor 'gyros' (did you mean 'gyro'?)");
    CHECK(refusal(out("TimedDouble", {"gyro", "metre"})) ==
          "robot.lua: port 'extra': a TimedDouble carries the value of one sensor, not of 2");
    CHECK(refusal(out("TimedPose3D", {"gyro"})) ==
          "robot.lua: port 'extra': a TimedPose3D can't carry sensors' values");
    CHECK(refusal(out("TimedPose2D", {"velocity"})) ==
          "robot.lua: port 'extra': 'velocity' is a TimedVelocity2D, not a TimedPose2D");
    CHECK(refusal([](PortSpec& p) { p.name = "yaw", p.items = {"drive"}; }) ==
          "robot.lua: port 'yaw': is declared twice");
    RobotSpec still = fake_mouse();
    for (PortSpec& port : still.ports) port.off_when_silent = port.name == "neck_in";
    CHECK(Robot::make("mouse", still, {}).error().message ==
          "port 'neck_in': silence = \"off\" has no meaning for the servo 'neck': it holds its angle");
}
