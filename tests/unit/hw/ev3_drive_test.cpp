// An EV3 drives on the fake brick: wheels, arm, sensors, lights, screen; each of them is also unplugged in motion.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/unit/hw/fake_ev3_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

constexpr double drive_degree = std::numbers::pi / 180;

template <class T>
void send(DrivenEv3& ev3, const char* port, const T& value) {
    static_cast<InPort<T>*>(ev3.robot->find_in_port(port))->inject(value);
}

}  // namespace

TEST_CASE("an EV3's wheels roll freely until the first command, and their motion is measured",
          "[hw][ev3][fakes][wallclock]") {
    FakeEv3 fake;
    DrivenEv3 ev3(fake);
    ev3.idle(0.3);
    CHECK(fake.motion().rolls);
    fake.say("disturb 0.1 - 0");
    ev3.idle(0.6);
    CHECK(ev3.published<Velocity2D>("current_vel").vx == Approx(0.1).margin(0.02));
    fake.say("disturb - - -");
    ev3.run(0.3, {});
    CHECK_FALSE(fake.motion().rolls);
    INFO(ev3.all_log());
    CHECK(ev3.log.empty());
}

TEST_CASE("an EV3 drives a square, and its odometry is right within 1 %", "[hw][ev3][fakes][odometry][wallclock]") {
    FakeEv3 fake;
    DrivenEv3 ev3(fake);
    ev3.run(0.3);
    constexpr double side = 0.2;  // [m]
    const auto pose = [&] { return ev3.published<Pose2D>("odometry"); };
    for (int corner = 0; corner < 4; ++corner) {
        const Pose2D from = pose();
        REQUIRE(ev3.run(5, {.vx = 0.2}, [&] {
            return std::hypot(pose().position.x - from.position.x, pose().position.y - from.position.y) > side - 0.02;
        }));
        ev3.run(0.4);
        const double heading = (corner + 1) * std::numbers::pi / 2;
        REQUIRE(ev3.run(5, {.va = 1},
                        [&] { return std::remainder(pose().heading - heading, 2 * std::numbers::pi) > -0.06; }));
        ev3.run(0.4);
    }
    const Pose2D truth = fake.truth();
    const double missed = std::hypot(pose().position.x - truth.position.x, pose().position.y - truth.position.y);
    CHECK(missed < 0.01 * 4 * side);
    CHECK(std::abs(std::remainder(pose().heading - truth.heading, 2 * std::numbers::pi)) < 0.01 * 2 * std::numbers::pi);
    CHECK(std::abs(std::remainder(ev3.published<double>("gyro") - pose().heading, 2 * std::numbers::pi)) < 0.1);
    WARN("odometry off by " << missed * 1e3 << " mm after a square of " << 4 * side << " m");
}

TEST_CASE("an EV3's sensors give their values in SI units", "[hw][ev3][fakes][threads][wallclock]") {
    FakeEv3 fake({"0.6"});  // a wall 0.05 m before that
    DrivenEv3 ev3(fake);
    fake.say("floor 300 300 300");
    ev3.run(0.5);
    INFO(ev3.all_log());
    CHECK(ev3.published<RangeData>("ultrasonic").ranges.at(0) == Approx(0.55 - 0.07).margin(0.02));
    CHECK(ev3.published<std::string>("color") == "white");
    CHECK(ev3.published<double>("light_reflect") == Approx(100).margin(1));
    CHECK(ev3.published<std::vector<bool>>("touch") == std::vector<bool>{false, false});
    fake.say("press right 1");
    fake.say("floor 30 25 20");
    ev3.run(1, {.va = 1}, [&] { return ev3.published<Pose2D>("odometry").heading > 0.5; });
    CHECK(ev3.published<std::vector<bool>>("touch") == std::vector<bool>{true, false});
    CHECK(ev3.published<std::string>("color") == "black");
    CHECK(ev3.published<double>("gyro") == Approx(0.5).margin(0.1));
    CHECK(ev3.published<double>("gyro_rate") == Approx(1).margin(0.15));
    CHECK_FALSE(ev3.speaks("light_ambient"));  // another mode of the colour sensor
    CHECK(ev3.log.empty());
}

TEST_CASE("an EV3's arm gets its target once, with its speed, and turns there", "[hw][ev3][fakes][wallclock]") {
    FakeEv3 fake;
    DrivenEv3 ev3(fake);
    ev3.run(0.2);
    send(ev3, "angle", 90 * drive_degree);
    ev3.run(0.5);
    const double underway = ev3.published<RangeData>("ultrasonic").geometry.pose.orientation.y;
    CHECK(underway == Approx(0.5 * 1.6).margin(0.35));  // at 1.6 rad/s
    ev3.run(1);
    CHECK(ev3.published<RangeData>("ultrasonic").geometry.pose.orientation.y == Approx(90 * drive_degree).margin(0.03));
    const auto writes = fake.writes();
    const auto count = [&](const std::string& write) { return std::count(writes.begin(), writes.end(), write); };
    CHECK(count("outA/position_sp '90'") == 1);
    CHECK(count("outA/speed_sp '92'") == 1);
    CHECK(count("outA/command 'run-to-abs-pos'") == 1);
    // It keeps its position after its cable was out, and counts on.
    fake.say("unplug outA");
    ev3.run(0.6);
    CHECK(ev3.said("motor 'medium_motor': "));
    fake.say("plug outA");
    CHECK(ev3.run(5, {}, [&] { return ev3.said("motor 'medium_motor': back again"); }));
    CHECK(ev3.published<RangeData>("ultrasonic").geometry.pose.orientation.y == Approx(90 * drive_degree).margin(0.03));
}

TEST_CASE("an EV3 shows lights and pictures", "[hw][ev3][fakes][threads][wallclock]") {
    FakeEv3 fake;
    DrivenEv3 ev3(fake);
    send(ev3, "leds", std::vector<bool>{true, false, false, true});
    send(ev3, "lcd", CameraImage{.width = 1, .height = 1, .bpp = 8, .format = "gray8", .fDiv = 0, .pixels = {0x80}});
    ev3.run(0.5);
    CHECK(fake.motion().leds == "1001");
    const std::string frame = fake.say("frame");
    REQUIRE(frame.size() == 2 * 712 * 128);
    CHECK(frame.substr(0, 8) == "ffffff00");
    CHECK(frame.substr(2 * (712 * 64 + 4 * 89), 8) == "80808000");
    CHECK(ev3.log.empty());
}

TEST_CASE("an EV3 with a low battery stops, reports it once, and drives again when it is charged",
          "[hw][ev3][fakes][safety][wallclock]") {
    FakeEv3 fake;
    DrivenEv3 ev3(fake);
    ev3.run(0.5, {.vx = 0.1});
    CHECK(ev3.robot->battery() == 7.9);
    fake.say("battery 6100000");
    ev3.run(1.2, {.vx = 0.1});
    CHECK(fake.moves());  // starting motors lower the voltage for a moment
    CHECK(ev3.robot->may_drive());
    REQUIRE(ev3.run(3, {.vx = 0.1}, [&] { return !fake.moves(); }));
    CHECK(ev3.log == std::vector<std::string>{"battery: is low, below 6.2 V: the robot stands until the battery is "
                                              "charged or its cells are changed"});
    CHECK(ev3.robot->battery() == 6.1);
    CHECK_FALSE(ev3.robot->may_drive());
    fake.say("battery 6300000");
    ev3.run(1, {.vx = 0.1});
    CHECK_FALSE(fake.moves());
    fake.say("battery 6500000");
    CHECK(ev3.run(2, {.vx = 0.1}, [&] { return fake.moves(); }));
}

namespace {

struct Unplugged {
    const char* port;
    const char* fault;  // "unplug", or a fault of the following node
    const char* node;
    const char* said;
    bool drives;
    std::vector<const char*> silent;
};

}  // namespace

TEST_CASE("each device of an EV3 that fails in motion is reported once and used again",
          "[hw][ev3][fakes][safety][wallclock]") {
    const auto fault = GENERATE(
        Unplugged{"outB", "unplug", "", "motors: outB: ", false, {"odometry", "current_vel"}},
        Unplugged{"outC", "unplug", "", "motors: outC: ", false, {"odometry", "current_vel"}},
        Unplugged{"outC", "eio", "outC/command", "motors: outC: ", false, {}},
        Unplugged{"outB", "hang", "outB/speed_sp", "motors: no answer for 0.3 s", false, {"odometry", "current_vel"}},
        Unplugged{"in2", "unplug", "", "sensor 'gyro': ", true, {"gyro", "gyro_rate"}},
        Unplugged{"in4", "unplug", "", "sensor 'ultrasonic': ", true, {"ultrasonic"}},
        Unplugged{"in4", "garbage", "in4/value0", "expected a number, got 'what?'", true, {"ultrasonic"}},
        Unplugged{"in5", "unplug", "", "sensor 'color': ", true, {"color", "light_reflect"}},
        Unplugged{"in5", "hang", "in5/value1", "sensor 'color': no answer", true, {"color", "light_reflect"}},
        Unplugged{"in3", "unplug", "", "sensor 'right': ", true, {"touch"}},
        Unplugged{"in1", "eio", "in1/value0", "sensor 'left': ", true, {"touch"}});
    INFO(fault.port << " " << fault.fault);
    FakeEv3 fake;
    DrivenEv3 ev3(fake);
    // A command that changes all the time, so that the motors' nodes are written.
    const auto drive = [&](double seconds, const std::function<bool()>& until = nullptr) {
        const double end = ev3.system.now().seconds + seconds;
        for (int i = 0; ev3.system.now().seconds < end; ++i) {
            ev3.run(0.025, {.vx = 0.1, .va = i % 2 == 0 ? 0.2 : -0.2});
            if (until && until()) return true;
        }
        return !until;
    };
    fake.say("press right 1");
    fake.say("press left 1");
    REQUIRE(drive(10, [&] {
        return fake.moves() && ev3.speaks("gyro") && ev3.speaks("ultrasonic") && ev3.speaks("color") &&
               ev3.published<std::vector<bool>>("touch") == std::vector<bool>{true, true};
    }));
    REQUIRE(ev3.log.empty());
    const bool is_cable = std::string_view(fault.fault) == "unplug";
    if (is_cable) {
        CHECK(fake.say(std::string("unplug ") + fault.port).empty());
    } else {
        fake.fault(fault.node, fault.fault);
    }
    drive(0.8);
    drive(3, [&] { return !ev3.log.empty() && fake.moves() == fault.drives; });
    INFO(ev3.all_log());
    CHECK(fake.moves() == fault.drives);
    CHECK(ev3.log.size() == 1);
    CHECK(ev3.said(fault.said));
    for (const char* port :
         {"odometry", "current_vel", "gyro", "gyro_rate", "ultrasonic", "color", "light_reflect", "touch"}) {
        INFO(port);
        const bool is_silent = std::any_of(fault.silent.begin(), fault.silent.end(),
                                           [&](const char* each) { return std::string_view(each) == port; });
        if (std::string_view(fault.fault) != "eio" || fault.drives) CHECK(ev3.speaks(port) == !is_silent);
    }
    if (is_cable) {
        CHECK(fake.say(std::string("plug ") + fault.port).empty());
    } else {
        fake.say("heal");
    }
    CHECK(drive(3, [&] {
        return fake.moves() && std::all_of(fault.silent.begin(), fault.silent.end(),
                                           [&](const char* port) { return ev3.speaks(port); });
    }));
}

TEST_CASE("an EV3 with one touch sensor gives two values, and the missing sensor is reported",
          "[hw][ev3][fakes][wallclock]") {
    FakeEv3 fake;
    fake.say("unplug in1");
    DrivenEv3 ev3(fake);
    ev3.run(5, {}, [&] { return !ev3.log.empty(); });
    CHECK(ev3.log == std::vector<std::string>{
                         "sensor 'left': nothing is plugged in at in1, expected a lego-ev3-touch: look at its cable"});
    fake.say("press right 1");
    ev3.run(0.2);
    CHECK(ev3.published<std::vector<bool>>("touch") == std::vector<bool>{true, false});
    fake.say("plug in1");
    fake.say("press left 1");
    ev3.run(1);
    CHECK(ev3.published<std::vector<bool>>("touch") == std::vector<bool>{true, true});
    // Now there are two sensors; without one of them the values are unknown.
    fake.say("unplug in1");
    ev3.run(0.6);
    CHECK_FALSE(ev3.speaks("touch"));
}

TEST_CASE("a sensor whose mode another program changed is switched back, and is silent meanwhile",
          "[hw][ev3][fakes][wallclock]") {
    FakeEv3 fake({"0.6"});
    DrivenEv3 ev3(fake);
    ev3.run(0.5);
    CHECK(fake.say("mode in4 US-DIST-IN").empty());
    double least = 1;
    ev3.run(0.6, {}, [&] {
        least = std::min(least, ev3.published<RangeData>("ultrasonic").ranges.at(0));
        return false;
    });
    CHECK(least > 0.4);  // inches would be 0.19
    CHECK(ev3.speaks("ultrasonic"));
    CHECK(ev3.log.empty());
}

TEST_CASE("a sensor that is late with a change of mode is reported once and used again",
          "[hw][ev3][fakes][threads][wallclock]") {
    FakeEv3 fake;
    fake.fault("in2/mode", "timeout");
    DrivenEv3 ev3(fake);
    CHECK(ev3.run(5, {}, [&] { return !ev3.log.empty(); }));
    ev3.run(0.5);
    REQUIRE(ev3.log.size() == 1);
    CHECK(ev3.said("sensor 'gyro': "));
    CHECK(ev3.said("connection timed out: look at its cable, and at what dmesg says"));
    fake.say("heal");
    CHECK(ev3.run(2, {}, [&] { return ev3.speaks("gyro"); }));
}

TEST_CASE("an EV3 whose motor fails repeatedly stops and reports it once", "[hw][ev3][fakes][safety][wallclock]") {
    const std::string node = GENERATE("outB/speed_sp", "outB/position", "outC/position");
    INFO(node);
    FakeEv3 fake;
    DrivenEv3 ev3(fake);
    REQUIRE(ev3.run(5, {.vx = 0.1}, [&] { return fake.moves(); }));
    fake.fault(node, "eio");
    // A new command in every tick, so that the motors' nodes are written.
    const auto drive = [&](double seconds, const std::function<bool()>& until = nullptr) {
        const double end = ev3.system.now().seconds + seconds;
        for (int i = 0; ev3.system.now().seconds < end; ++i) {
            ev3.run(0.025, {.vx = i % 2 == 0 ? 0.1 : 0.11});
            if (until && until()) return true;
        }
        return !until;
    };
    CHECK(drive(5, [&] { return !fake.moves(); }));
    const Pose2D stood = fake.truth();
    drive(2);  // it is tried again every half second
    CHECK(std::abs(fake.truth().position.x - stood.position.x) < 0.005);
    INFO(ev3.all_log());
    CHECK(ev3.log.size() == 1);
    CHECK(ev3.said("motors: " + node.substr(0, 4) + ": "));
    fake.say("heal");
    CHECK(drive(5, [&] { return fake.moves() && ev3.said("motors: back again"); }));
    CHECK(ev3.log.size() == 2);
}
