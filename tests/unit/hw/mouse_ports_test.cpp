// Assignment of a mouse's devices to the sensors of its robot file.
#include <algorithm>

#include "hw/raspimouse/mouse_body.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

TEST_CASE("a mouse's sensors are the devices of its robot file, the others follow in order",
          "[hw][mouse][fakes][wallclock]") {
    FakeMouse fake;
    RobotSpec spec = mouse_spec();
    for (SensorSpec& sensor : spec.sensors) {
        if (sensor.name == "switch0") sensor.port = "rtswitch2";
    }
    DrivenRobot mouse(spec, fake.roots());
    const auto pressed = [&] { return mouse.published<std::vector<bool>>("switch3bit_out"); };
    const auto is = [&](const std::vector<bool>& wanted) {
        return mouse.run(2, {}, [&] { return pressed() == wanted; });
    };
    fake.say("button 2 1");
    CHECK(is({true, false, false}));
    fake.say("button 2 0");
    fake.say("button 0 1");
    CHECK(is({false, true, false}));
    fake.say("button 0 0");
    fake.say("button 1 1");
    CHECK(is({false, false, true}));
}

TEST_CASE("a mouse's light sensors are in the driver's order: right front, right side, left side, left front",
          "[hw][mouse]") {
    RobotSpec spec = mouse_spec();
    const auto place = [&](std::string_view name) {
        const auto sensor =
            std::find_if(spec.sensors.begin(), spec.sensors.end(), [&](const auto& each) { return each.name == name; });
        return static_cast<std::size_t>(sensor - spec.sensors.begin());
    };
    const auto read = [&] {
        const Scratch folder;  // a new folder, because a guard may hold the previous motors for a moment
        for (const char* node : {"rtmotoren0", "rtmotor_raw_l0", "rtmotor_raw_r0"}) folder.write(node, "");
        folder.write("rtlightsensor0", "10 200 300 400\n");
        auto body = MouseBody::make(spec, {.dev = folder.path("").string(), .sys = ""});
        REQUIRE(body);
        std::vector<double> values;
        REQUIRE(FakeRobot::wait_until([&] { return (*body)->read_sensors({}, 0.01)[place("left_side")].is_there; }, 3));
        for (const char* name : {"right_front", "right_side", "left_side", "left_front"})
            values.push_back((*body)->read_sensors({}, 0.01)[place(name)].value);
        return values;
    };
    CHECK(read() == std::vector<double>{10, 200, 300, 400});
    // Another robot has them at other places.
    spec.sensors[place("right_front")].port = "3";
    spec.sensors[place("left_front")].port = "";
    CHECK(read() == std::vector<double>{400, 200, 300, 10});
}

TEST_CASE("a port that is unknown to a mouse is refused", "[hw][mouse]") {
    const auto refusal = [](const std::function<void(RobotSpec&)>& change) {
        RobotSpec spec = mouse_spec();
        change(spec);
        const auto body = MouseBody::make(spec, {.dev = "/nowhere", .sys = ""});
        REQUIRE_FALSE(body);
        return body.error().message;
    };
    CHECK(refusal([](RobotSpec& spec) {
              spec.drive.port = {"a", "b"};
          }) == "drive.port of model 'raspimouse' has no meaning for the driver raspimouse: leave it out");
    CHECK(refusal([](RobotSpec& spec) {
              for (ActuatorSpec& actuator : spec.actuators) {
                  if (actuator.name == "buzzer") actuator.port = "rtbuzzer0";
              }
          }) ==
          "port of actuator 'buzzer' of model 'raspimouse' has no meaning for the driver raspimouse: leave it out");
    const auto with_ports = [&](SensorSpec::Kind kind, const std::string& port, int count) {
        return refusal([&](RobotSpec& spec) {
            int given = 0;
            for (SensorSpec& sensor : spec.sensors) {
                if (sensor.kind == kind && given++ < count) sensor.port = port;
            }
        });
    };
    CHECK(with_ports(SensorSpec::Kind::button, "rtswitch3", 1)
              .ends_with("port: expected one of rtswitch0, rtswitch1, rtswitch2, got 'rtswitch3'"));
    CHECK(with_ports(SensorSpec::Kind::range, "x", 1).ends_with("port: expected one of 0, 1, 2, 3, got 'x'"));
    CHECK(with_ports(SensorSpec::Kind::range, "2", 2).ends_with("port: another sensor has '2' already"));
}
