// The mouse's driver on fake nodes that behave like the real driver's, with simulated physics.
#include "hw/raspimouse/mouse_body.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <numbers>

#include "tests/unit/hw/fake_mouse_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

using Lines = std::vector<std::string>;

TEST_CASE("if motors or their power are missing, nothing is written and the error says what to do",
          "[hw][mouse][safety]") {
    const RobotSpec spec = mouse_spec();
    for (const std::string missing : {"rtmotoren0", "rtmotor_raw_l0", "rtmotor_raw_r0"}) {
        const Scratch folder;
        for (const char* node : {"rtmotoren0", "rtmotor_raw_l0", "rtmotor_raw_r0"}) {
            if (node != missing) folder.write(node, "untouched");
        }
        const auto body = MouseBody::make(spec, {.dev = folder.path("").string(), .sys = ""});
        REQUIRE_FALSE(body);
        CHECK(body.error().message ==
              "motors: " + folder.path("").string() + "/" + missing +
                  ": no such file or directory: is the driver loaded? Try: sudo modprobe rtmouse");
        for (const char* node : {"rtmotoren0", "rtmotor_raw_l0", "rtmotor_raw_r0"}) {
            std::string text;
            std::ifstream(folder.path(node)) >> text;
            CHECK((node == missing ? text.empty() : text == "untouched"));
        }
    }
}

TEST_CASE("a second program is refused because another robot drives the mouse", "[hw][mouse][safety]") {
    const RobotSpec spec = mouse_spec();
    const Scratch folder;
    for (const char* node : {"rtmotoren0", "rtmotor_raw_l0", "rtmotor_raw_r0"}) folder.write(node, "");
    const DeviceRoots roots{.dev = folder.path("dev").parent_path().string(), .sys = ""};
    const auto first = MouseBody::make(spec, roots);
    REQUIRE(first);
    const auto second = MouseBody::make(spec, roots);
    REQUIRE_FALSE(second);
    CHECK(second.error().message.find("another robot of this system drives these motors already") != std::string::npos);
}

TEST_CASE("a robot file that the driver can't serve is refused", "[hw][mouse]") {
    RobotSpec spec = mouse_spec();
    spec.sensors.push_back(spec.sensors.front());
    spec.sensors.back().port.clear();
    const auto body = MouseBody::make(spec, {});
    REQUIRE_FALSE(body);
    CHECK(body.error().message ==
          "the driver raspimouse has 4 distance sensors and 3 buttons, but model 'raspimouse' needs more");
}

TEST_CASE("a drive with a tone and two LEDs makes exactly these writes to device files",
          "[hw][mouse][fakes][wallclock]") {
    FakeMouse fake;
    {
        auto body = MouseBody::make(mouse_spec(), fake.roots());
        REQUIRE(body);
        // The command is repeated, as in a loop, until the nodes have it.
        const auto tell = [&](const std::function<void()>& command,
                              const std::function<bool(FakeMouse::Motion)>& done) {
            CHECK(FakeMouse::wait_until(
                [&] {
                    command();
                    sleep_for(0.01);
                    return done(fake.motion());
                },
                2));
        };
        constexpr double pulse = 2 * std::numbers::pi * 0.024 / 400;  // [m]
        const auto drive = [&](int left, int right) {
            tell([&] { (*body)->set_wheel_speeds({.left = left * pulse, .right = right * pulse}); },
                 [=](const FakeMouse::Motion& is) { return is.left == left && is.right == right; });
        };
        (*body)->set_buzzer(440);
        tell([] {}, [](const FakeMouse::Motion& is) { return is.tone == 440; });
        (*body)->set_leds({true, false, false, true});
        tell([] {}, [](const FakeMouse::Motion& is) { return is.leds == "1001"; });
        (*body)->set_motor_power(true);
        drive(45, 40);
        (*body)->set_buzzer(0);
        drive(45, -45);
        drive(0, 0);
        (*body)->set_motor_power(false);
        tell([] {}, [](const FakeMouse::Motion& is) { return !is.power; });
    }
    Lines written = fake.writes();
    REQUIRE(written.size() > 3);
    // The guard stops the power and both motors in any order; here they are sorted by name.
    std::sort(written.end() - 3, written.end());
    CHECK(written == Lines{// the start: no power, no motion
                           "rtmotoren0 '0'", "rtmotor_raw_l0 '0'", "rtmotor_raw_r0 '0'",
                           // a tone, two LEDs
                           "rtbuzzer0 '440'", "rtled0 '1'", "rtled3 '1'",
                           // the tone ends, power comes, the wheels turn
                           "rtbuzzer0 '0'", "rtmotoren0 '1'", "rtmotor_raw_l0 '45'", "rtmotor_raw_r0 '40'",
                           // only what changes
                           "rtmotor_raw_r0 '-45'", "rtmotor_raw_l0 '0'", "rtmotor_raw_r0 '0'", "rtmotoren0 '0'",
                           // the end, by the driver and by its guard
                           "rtmotoren0 '0'", "rtmotor_raw_l0 '0'", "rtmotor_raw_r0 '0'",  //
                           "rtmotor_raw_l0 '0'", "rtmotor_raw_r0 '0'", "rtmotoren0 '0'"});
}

TEST_CASE("motors have power while the robot is active, and not when it is deactivated",
          "[hw][mouse][fakes][safety][wallclock]") {
    FakeMouse fake;
    CHECK(fake.motion().power);  // as the driver leaves it when it is loaded
    DrivenMouse mouse(fake);
    CHECK_FALSE(fake.motion().power);
    mouse.run(0.5, {.vx = 0.1});
    CHECK(fake.motion().power);
    CHECK(fake.moves());
    REQUIRE(mouse.robot->deactivate(mouse.system.now()));
    mouse.run(1.2);
    CHECK_FALSE(fake.motion().power);
    CHECK(mouse.log.empty());
    REQUIRE(mouse.robot->activate(mouse.system.now()));
    mouse.run(0.5, {.vx = 0.1});
    CHECK(fake.moves());
}

TEST_CASE("a control loop that stalls leaves the wheels standing until it commands again",
          "[hw][mouse][fakes][safety][wallclock]") {
    FakeMouse fake;
    DrivenMouse mouse(fake);
    mouse.run(0.6, {.vx = 0.1});
    REQUIRE(fake.moves());
    // The driver's threads continue, as during an endless script.
    sleep_for(0.25);
    bool has_moved = false;
    for (int i = 0; i < 75; ++i) {
        has_moved = has_moved || fake.moves();
        sleep_for(0.01);
    }
    CHECK_FALSE(has_moved);
    CHECK(mouse.run(3, {.vx = 0.1}, [&] { return fake.moves(); }));
    INFO(mouse.all_log() << fake.say("log"));
    CHECK(fake.moves());
}

TEST_CASE("a mouse drives a square over the counters' wrap, and its odometry is right within 1 %",
          "[hw][mouse][fakes][odometry][wallclock]") {
    FakeMouse fake;
    fake.say("counters 65100");
    DrivenMouse mouse(fake);
    mouse.run(0.3);
    constexpr double side = 0.2;  // [m]
    const auto pose = [&] { return mouse.published<Pose2D>("current_pose_out"); };
    for (int corner = 0; corner < 4; ++corner) {
        const Pose2D from = pose();
        REQUIRE(mouse.run(5, {.vx = 0.15}, [&] {
            return std::hypot(pose().position.x - from.position.x, pose().position.y - from.position.y) > side - 0.02;
        }));
        mouse.run(0.5);
        const double heading = (corner + 1) * std::numbers::pi / 2;
        REQUIRE(mouse.run(5, {.va = 1.5}, [&] {
            return std::remainder(pose().heading - heading, 2 * std::numbers::pi) > -0.25 &&
                   std::abs(std::remainder(pose().heading - heading, 2 * std::numbers::pi)) < 1;
        }));
        mouse.run(0.5);
    }
    const Pose2D truth = fake.truth(), counted = pose();
    const double path = 4 * side;
    INFO("truth " << truth.position.x << " " << truth.position.y << ", odometry " << counted.position.x << " "
                  << counted.position.y);
    const double off = std::hypot(truth.position.x - counted.position.x, truth.position.y - counted.position.y);
    const double turned = std::abs(std::remainder(truth.heading - counted.heading, 2 * std::numbers::pi));
    CHECK(off < 0.01 * path);
    CHECK(turned < 0.01 * 2 * std::numbers::pi);
    CHECK(mouse.log.empty());
    WARN("off by " << off / path * 100 << " % of the path and " << turned / (2 * std::numbers::pi) * 100
                   << " % of the turn");
}

TEST_CASE("velocity is measured at the wheels, and sensors' values have the time of their reading",
          "[hw][mouse][fakes][threads][wallclock]") {
    FakeMouse fake({"0.25"});  // a wall's front at 0.2 m
    DrivenMouse mouse(fake);
    mouse.run(0.5, {.vx = 0.1});
    Velocity2D sum;
    int ticks = 0;
    mouse.run(0.3, {.vx = 0.1}, [&] {
        sum.vx += mouse.published<Velocity2D>("current_velocity_out").vx;
        sum.va += mouse.published<Velocity2D>("current_velocity_out").va;
        ++ticks;
        return false;
    });
    CHECK(sum.vx / ticks == Approx(0.1).epsilon(0.08));
    CHECK(sum.va / ticks == Approx(0).margin(0.1));
    const auto& values = mouse.published<std::vector<std::int16_t>>("ir_sensor_out");
    REQUIRE(values.size() == 4);
    CHECK(values[0] > 15);
    const double x = fake.truth().position.x;
    const auto& metres = mouse.published<std::vector<double>>("ir_sensor_metre_out");
    CHECK(metres[0] == Approx(0.2 - 0.035 - x).margin(0.02));
    for (const char* port : {"ir_sensor_out", "current_velocity_out", "switch3bit_out"}) {
        const double age = mouse.system.now().seconds - mouse.robot->find_out_port(port)->tm();
        INFO(port << " " << age);
        CHECK(age > 0);
        CHECK(age < 0.12);
    }
    fake.say("button 1 1");
    mouse.run(0.2);
    CHECK(mouse.published<std::vector<bool>>("switch3bit_out") == std::vector<bool>{false, true, false});
}

namespace {

struct FaultCase {
    const char* node;
    const char* fault;
    const char* said;    // part of the message; "": none
    bool drives;         // true if the robot continues to drive
    const char* silent;  // the silent port; "": none
};

}  // namespace

TEST_CASE("each device that fails in motion stops the robot or only its port, is reported once, and is used again",
          "[hw][mouse][fakes][safety][wallclock]") {
    const auto fault =
        GENERATE(FaultCase{"rtmotor_raw_l0", "eio", "motors: ", false, ""},
                 FaultCase{"rtmotor_raw_r0", "enodev", "motors: ", false, ""},
                 FaultCase{"rtmotor_raw_l0", "hang", "motors: no answer for 0.3 s", false, ""},
                 FaultCase{"rtlightsensor0", "eio", "light sensors: ", false, "ir_sensor_out"},
                 FaultCase{"rtlightsensor0", "hang", "light sensors: no answer for 0.3 s", false, "ir_sensor_out"},
                 FaultCase{"rtlightsensor0", "zeros", "gives only 0 0 0 0", false, "ir_sensor_out"},
                 FaultCase{"rtlightsensor0", "garbage", "expected four numbers, got 'what?", false, "ir_sensor_out"},
                 FaultCase{"rtswitch1", "eio", "switches: ", true, "switch3bit_out"},
                 FaultCase{"rtcounter_l0", "eio", "wheel counters: ", true, "current_pose_out"},
                 FaultCase{"rtcounter_r0", "zeros", "wheel counters: they give 0", true, "current_velocity_out"},
                 FaultCase{"rtcounter_r0", "tear", "", true, ""});
    INFO(fault.node << " " << fault.fault);
    FakeMouse fake;
    DrivenMouse mouse(fake);
    // A command that changes all the time, so that the motors' nodes are written.
    const auto drive = [&](double seconds, const std::function<bool()>& until = nullptr) {
        const double end = mouse.system.now().seconds + seconds;
        for (int i = 0; mouse.system.now().seconds < end; ++i) {
            mouse.run(0.025, {.vx = 0.1, .va = i % 2 == 0 ? 0.1 : -0.1});
            if (until && until()) return true;
        }
        return !until;
    };
    drive(0.5);
    REQUIRE(fake.moves());
    REQUIRE(mouse.log.empty());
    fake.fault(fault.node, fault.fault);
    drive(*fault.fault == 'z' ? 2.4 : 0.9);
    std::string log;
    for (const auto& line : mouse.log) log += line + "\n";
    INFO(log);
    CHECK(fake.moves() == fault.drives);
    // The mouse needs its light sensors: without them it stands and reports that too.
    const bool is_blind = std::string_view(fault.silent) == "ir_sensor_out";
    CHECK(mouse.log.size() == (*fault.said == '\0' ? 0 : is_blind ? 2 : 1));
    CHECK(mouse.said("stands: it needs readings of ") == is_blind);
    CHECK((*fault.said == '\0' || mouse.said(fault.said)));
    for (const char* port : {"ir_sensor_out", "switch3bit_out", "current_pose_out", "current_velocity_out"}) {
        const bool same_device =
            std::string_view(fault.silent).starts_with("current") && std::string_view(port).starts_with("current");
        INFO(port);
        CHECK(mouse.speaks(port) == !(same_device || std::string_view(port) == fault.silent));
    }
    fake.fault(fault.node, "none");
    CHECK(drive(2, [&] { return fake.moves() && (*fault.silent == '\0' || mouse.speaks(fault.silent)); }));
}

TEST_CASE("a reloaded driver is used again, motors first", "[hw][mouse][fakes][safety][threads][wallclock]") {
    FakeMouse fake;
    DrivenMouse mouse(fake);
    mouse.run(0.5, {.vx = 0.1});
    const double before = mouse.published<Pose2D>("current_pose_out").position.x;
    fake.say("reload");
    mouse.run(1.5, {.vx = 0.1});
    CHECK(fake.moves());
    CHECK(mouse.said("motors: the driver's nodes have gone"));
    CHECK(mouse.published<Pose2D>("current_pose_out").position.x > before + 0.05);
    const double truth = fake.truth().position.x;
    CHECK(mouse.published<Pose2D>("current_pose_out").position.x == Approx(truth).margin(0.02));
}

TEST_CASE("counters that another program has switched to signed are switched back", "[hw][mouse][fakes][wallclock]") {
    FakeMouse fake;
    fake.say("counters 30000");
    DrivenMouse mouse(fake);
    mouse.run(0.5, {.vx = -0.1});
    fake.say("signed");
    mouse.run(0.7, {.vx = -0.1});
    CHECK(mouse.log.empty());
    CHECK(mouse.published<Pose2D>("current_pose_out").position.x == Approx(fake.truth().position.x).margin(0.01));
}

TEST_CASE("a mouse stops while its Raspberry Pi has too little voltage, then drives again",
          "[hw][mouse][fakes][safety][wallclock]") {
    FakeMouse fake;
    fake.folder.write("sys/class/hwmon/hwmon0/name", "cpu_thermal\n");
    fake.folder.write("sys/class/hwmon/hwmon3/name", "rpi_volt\n");
    fake.folder.write("sys/class/hwmon/hwmon3/in0_lcrit_alarm", "0\n");
    DrivenMouse mouse(fake);
    REQUIRE(mouse.run(3, {.vx = 0.1}, [&] { return fake.motion().left > 250; }));
    // Written in place like the kernel's file, so it is never empty.
    const auto set_alarm = [&](char on) {
        std::fstream file(fake.folder.path("sys/class/hwmon/hwmon3/in0_lcrit_alarm"));
        file.put(on);
    };
    set_alarm('1');
    CHECK(mouse.run(2, {.vx = 0.1}, [&] { return !fake.moves(); }));
    CHECK(
        mouse.said("power supply: is low, the Raspberry Pi gets less than 4.63 V: the robot stands until its battery "
                   "has been charged or changed"));
    set_alarm('0');
    CHECK(mouse.run(3, {.vx = 0.1}, [&] { return fake.motion().left > 250; }));
    CHECK(mouse.run(5, {.vx = 0.1}, [&] { return mouse.said("power supply: back again"); }));
    INFO(mouse.all_log());
    CHECK(mouse.log.size() == 2);
}
