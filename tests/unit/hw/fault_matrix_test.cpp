// Every device with every fault, in motion.
#include <sys/stat.h>

#include <filesystem>

#include "engine/devices/camera.hpp"
#include "engine/devices/joystick.hpp"
#include "hw/camera/video_camera.hpp"
#include "tests/unit/hw/fake_ev3_rig.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"
#include "tests/unit/hw/fault_matrix.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

template <class T>
void inject(DrivenRobot& driven, const char* port, const T& value) {
    dynamic_cast<InPort<T>&>(*driven.robot->find_in_port(port)).inject(value);
}

// A tone sounds at standstill only.
bool beep(DrivenRobot& driven, FakeRobot& /*fake*/, int step) {
    constexpr int cycle = 48;
    if (step % cycle == 12) inject<std::int16_t>(driven, "buzzer_hz_in", 440);
    if (step % cycle == 22) inject<std::int16_t>(driven, "buzzer_hz_in", 0);
    return step % cycle >= cycle / 2;
}

// Motors are switched off when the robot is deactivated, and on when it is activated.
bool switch_power(DrivenRobot& driven, FakeRobot& /*fake*/, int step) {
    if (step == 0) REQUIRE(driven.robot->deactivate(driven.system.now()));
    if (step == 44) REQUIRE(driven.robot->activate(driven.system.now()));
    return true;
}

bool show_pictures(DrivenRobot& driven, FakeRobot& /*fake*/, int step) {
    if (step % 10 != 0) return true;
    const auto grey = static_cast<std::uint8_t>(driven.system.now().tick % 251);
    inject(driven, "lcd", CameraImage{.width = 2, .height = 2, .bpp = 8, .pixels = {grey, grey, grey, grey}});
    return true;
}

bool turn_arm(DrivenRobot& driven, FakeRobot& /*fake*/, int step) {
    if (step % 16 == 0) inject(driven, "angle", step % 32 == 0 ? 0.2 : -0.2);
    return true;
}

bool make_sounds(DrivenRobot& driven, FakeRobot& /*fake*/, int step) {
    if (step % 16 == 0) inject(driven, "sound", std::string("beep"));
    return true;
}

// Another program changes the gyro's mode; it must be changed back.
bool disturb_gyro(DrivenRobot& /*driven*/, FakeRobot& fake, int step) {
    if (step == 4) REQUIRE(fake.say("mode in2 GYRO-RATE").empty());
    return true;
}

// A mouse that carries a camera.
struct SeeingMouse : DrivenMouse {
    explicit SeeingMouse(FakeMouse& fake) : DrivenMouse(fake) {
        ComponentEntry entry;
        entry.name = "eye";
        auto made = device_drivers(fake.roots()).at("Camera").begin()->second(entry, system);
        REQUIRE(made);
        eye = made->get();
        REQUIRE(eye->parameters().set_all({{"width", std::int64_t{320}}, {"height", std::int64_t{240}}}));
        REQUIRE(system.add(std::move(*made)));
        REQUIRE(eye->activate(system.now()));
    }
    // Its pictures come 30 times per second, some of them late.
    bool speaks(std::string_view port) const {
        return port == "eye.out" ? system.now().seconds - std::as_const(*eye).find_out_port("out")->tm() < 0.5
                                 : DrivenMouse::speaks(port);
    }
    Component* eye = nullptr;
};

// A mouse that a gamepad drives.
struct SteeredMouse : DrivenMouse {
    SteeredMouse(FakeMouse& fake, const DeviceRoots& pads) : DrivenMouse(fake) {
        ComponentEntry entry;
        entry.name = "stick";
        auto made = device_drivers(pads).at("Joystick").at("gamepad")(entry, system);
        REQUIRE(made);
        stick = made->get();
        REQUIRE(system.add(std::move(*made)));
        REQUIRE(stick->activate(system.now()));
    }
    const OutPort<std::vector<float>>& pos() const {
        return static_cast<const OutPort<std::vector<float>>&>(*std::as_const(*stick).find_out_port("pos"));
    }
    bool run(double seconds, const Velocity2D& wanted) {
        return run_paced(system, seconds, nullptr, [&] {
            if (std::exchange(taken, pos().count()) == pos().count()) return;
            const double ahead = pos().read().at(1) / 150;
            velocity_in().inject(Velocity2D{.vx = ahead * wanted.vx, .va = ahead * wanted.va});
        });
    }
    bool speaks(std::string_view /*port*/) const { return system.now().seconds - pos().tm() < 0.1; }
    Component* stick = nullptr;
    std::uint64_t taken = 0;
};

// A brick's keys are sensors without a port.
struct KeyedEv3 : DrivenEv3 {
    explicit KeyedEv3(FakeEv3& fake) : DrivenEv3(fake) {}
    bool speaks(std::string_view sensor) const {
        for (std::size_t i = 0; i < spec.sensors.size(); ++i) {
            if (spec.sensors[i].name == sensor) return robot->readings()[i].is_there;
        }
        return false;
    }
};

// A folder of programs as the whole PATH, with a sound player.
struct Player {
    Player() {
        set("none");
        setenv("PATH", folder.path("").c_str(), 1);
    }
    ~Player() { setenv("PATH", path.c_str(), 1); }
    Player(const Player&) = delete;
    Player& operator=(const Player&) = delete;
    void set(const std::string& fault) const {
        std::filesystem::remove(folder.path("aplay"));
        if (fault == "missing") return;
        chmod(folder.write("aplay", fault == "fails" ? "#!/bin/sh\nexit 1\n" : "#!/bin/sh\nexit 0\n").c_str(), 0755);
    }
    const Scratch folder;
    const std::string path = std::getenv("PATH");
};

template <class Fake, class Driven>
void try_all(Fake& fake, Driven& driven, const FailingDevice& device, std::map<std::string, std::string> places = {}) {
    INFO(device.device);
    places[fake.mount()] = device.robot == "mouse" ? "/dev" : "";
    std::string rows;
    for (const std::string& fault : device.faults) rows += row(fake, driven, device, fault, places);
    compare(device, rows);
}

const std::vector<std::string> when_written{"missing", "denied", "eio", "enodev", "hang"};
const std::vector<std::string> when_read{"missing", "denied", "eio", "enodev", "hang", "garbage", "frozen"};
const std::vector<std::string> when_counted{"missing", "denied", "eio",   "enodev", "hang",
                                            "garbage", "frozen", "zeros", "tear"};

}  // namespace

TEST_CASE("each fault of each device of the mouse in motion has the effect that the page says",
          "[hw][mouse][fakes][safety][.][matrix]") {
    const std::vector<std::string> odometry{"current_pose_out", "current_velocity_out"};
    const std::vector<std::string> ranges{"ir_sensor_out", "ir_sensor_metre_out"};
    const auto device = GENERATE_COPY(values<FailingDevice>({
        {"mouse", "left motor", "rtmotor_raw_l0", when_written, odometry},
        {"mouse", "right motor", "rtmotor_raw_r0", when_written, odometry},
        {"mouse", "motor power", "rtmotoren0", when_written, odometry, 1.6, switch_power},
        {"mouse", "left counter", "rtcounter_l0", when_counted, odometry},
        {"mouse", "right counter", "rtcounter_r0", when_counted, odometry},
        {"mouse", "both counters", "", {"signed"}, odometry},
        {"mouse",
         "distance sensors",
         "rtlightsensor0",
         {"missing", "denied", "eio", "enodev", "hang", "garbage", "frozen", "zeros"},
         ranges},
        {"mouse", "switch 1", "rtswitch1", when_read, {"switch3bit_out"}},
        {"mouse", "light 0", "rtled0", when_written, {}},
        {"mouse", "buzzer", "rtbuzzer0", when_written, {}, 1.5, beep},
        {"mouse", "all of the driver", "", {"reload"}, {"ir_sensor_out", "switch3bit_out", "current_pose_out"}, 2.5},
    }));
    FakeMouse fake;
    DrivenMouse driven(fake);
    try_all(fake, driven, device);
}

TEST_CASE("each fault of a Pi's voltage monitor in motion has the effect that the page says",
          "[hw][mouse][fakes][safety][.][matrix]") {
    FakeMouse fake;
    const std::string folder = "sys/class/hwmon/hwmon0/", alarm = folder + "in0_lcrit_alarm";
    fake.folder.write(folder + "name", "rpi_volt\n");
    fake.folder.write(alarm, "0\n");
    FailingDevice device{
        .robot = "mouse", .device = "Pi's voltage", .node = "", .faults = {"low", "garbage"}, .ports = {}};
    // Written in place like the kernel's file, so it is never empty.
    device.set = [&](const std::string& fault) {
        std::fstream(fake.folder.path(alarm)).put(fault == "low" ? '1' : fault == "garbage" ? '?' : '0');
    };
    DrivenMouse driven(fake);
    try_all(fake, driven, device, {{fake.folder.path("sys").string(), "/sys"}});
}

TEST_CASE("each fault of a gamepad that drives a mouse has the effect that the page says",
          "[hw][mouse][gamepad][fakes][safety][.][matrix]") {
    FakeRobot pad("fake_gamepad", "");
    const auto push_ahead = [&] { REQUIRE(pad.say("set ABS_Y -32768").empty()); };
    push_ahead();
    FailingDevice device{.robot = "mouse",
                         .device = "gamepad",
                         .node = "",
                         .faults = {"unplugged", "denied", "eio", "hang"},
                         .ports = {"stick.pos"},
                         .told_within = 1.5};
    bool is_unplugged = false;
    device.set = [&](const std::string& fault) {
        if (fault == "none") {
            REQUIRE(pad.say(std::exchange(is_unplugged, false) ? "plug" : "heal").empty());
            push_ahead();
        } else {
            is_unplugged = fault == "unplugged";
            REQUIRE(pad.say(is_unplugged ? "unplug" : "fault " + fault).empty());
        }
    };
    FakeMouse fake;
    SteeredMouse driven(fake, {.dev = pad.mount(), .sys = ""});
    try_all(fake, driven, device, {{pad.mount(), "/dev"}});
}

TEST_CASE("each fault of a mouse's camera in motion has the effect that the page says",
          "[hw][mouse][camera][fakes][safety][.][matrix]") {
    const FailingDevice device{.robot = "mouse",
                               .device = "camera",
                               .node = "video0",
                               .faults = {"unplugged", "denied", "busy", "eio", "enodev", "hang", "silent"},
                               .ports = {"eye.out"},
                               .told_within = VideoCamera::slowest_opening + 2};
    FakeMouse fake;
    SeeingMouse driven(fake);
    try_all(fake, driven, device);
}

TEST_CASE("each fault of each device of the EV3 in motion has the effect that the page says",
          "[hw][ev3][fakes][safety][.][matrix]") {
    const std::vector<std::string> all{"missing", "denied", "eio", "timeout", "hang", "garbage"};
    const std::vector<std::string> cable{"unplugged"}, sensor{"unplugged", "mode"};
    const std::vector<std::string> odometry{"odometry", "current_vel"}, gyro{"gyro", "gyro_rate"};
    const std::vector<std::string> colours{"color", "light_reflect"};
    auto battery = all;
    battery.emplace_back("low");
    const auto device = GENERATE_COPY(values<FailingDevice>({
        {"EV3", "left motor", "outB", cable, odometry},
        {"EV3", "left motor's command", "outB/command", all, odometry},
        {"EV3", "left motor's speed", "outB/speed_sp", all, odometry},
        {"EV3", "left motor's position", "outB/position", all, odometry},
        {"EV3", "right motor", "outC", cable, odometry},
        {"EV3", "arm's motor", "outA", cable, {}, 1, turn_arm},
        {"EV3", "arm's command", "outA/command", all, {}, 1, turn_arm},
        {"EV3", "arm's target", "outA/position_sp", all, {}, 1, turn_arm},
        {"EV3", "right touch sensor", "in3", cable, {"touch"}},
        {"EV3", "right touch sensor's value", "in3/value0", all, {"touch"}},
        {"EV3", "left touch sensor", "in1", cable, {"touch"}},
        {"EV3", "left touch sensor's value", "in1/value0", all, {"touch"}},
        {"EV3", "ultrasonic sensor", "in4", sensor, {"ultrasonic"}, 1, nullptr, true, "US-DIST-IN"},
        {"EV3", "ultrasonic sensor's value", "in4/value0", all, {"ultrasonic"}},
        {"EV3", "gyro", "in2", sensor, gyro, 1, nullptr, true, "GYRO-RATE"},
        {"EV3", "gyro's value", "in2/value0", all, gyro},
        {"EV3", "gyro's mode", "in2/mode", all, gyro, 1, disturb_gyro},
        {"EV3", "colour sensor", "in5", sensor, colours, 1, nullptr, true, "COL-AMBIENT"},
        {"EV3", "colour sensor's value", "in5/value0", all, colours},
        {"EV3", "battery", "battery", battery, {}},
        {"EV3", "left red light", "led0:red", all, {}},
        {"EV3", "screen", "fb0", all, {}, 1, show_pictures},
    }));
    FakeEv3 fake;
    fake.say("press right 1");
    fake.say("press left 1");
    DrivenEv3 driven(fake);
    try_all(fake, driven, device);
}

TEST_CASE("each fault of an EV3's keys in motion has the effect that the page says",
          "[hw][ev3][fakes][safety][.][matrix]") {
    FakeEv3 fake;
    KeyedEv3 driven(fake);
    try_all(fake, driven,
            {.robot = "EV3",
             .device = "keys",
             .node = "keys",
             .faults = {"missing", "denied", "eio", "hang"},
             .ports = {"key_enter"}});
}

TEST_CASE("each fault of an EV3's loudspeaker in motion has the effect that the page says",
          "[hw][ev3][sound][fakes][safety][.][matrix]") {
    FakeEv3 fake;
    const Player player;
    DrivenEv3 driven(fake);
    try_all(fake, driven,
            {.robot = "EV3",
             .device = "loudspeaker",
             .node = "",
             .faults = {"missing", "fails"},
             .ports = {},
             .use = make_sounds,
             .leaves_mark = false,
             .set = [&](const std::string& fault) { player.set(fault); }});
}
