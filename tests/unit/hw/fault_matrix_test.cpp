// Every device with every fault, in motion: what the robot does, what it says, whether it comes back. The page's table
// is what happens.
#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "engine/base/whole_file.hpp"
#include "engine/devices/camera.hpp"
#include "hw/camera/video_camera.hpp"
#include "hw/device/health.hpp"
#include "tests/unit/hw/fake_ev3_rig.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

const std::string page = source_root() + "/docs/hardware.md";

// [s] after which at the latest it is told that a device works again.
constexpr double told_back = Health::proven_after + 0.5;

// A device of a robot: the node that fails, and the ports that hang on the device.
struct FailingDevice {
    std::string robot, device, node;
    std::vector<std::string> faults;
    std::vector<std::string> ports;
    double told_within = 1;  // [s] after which at the latest it is told that it fails
};

// What is told, sorted, without what differs from run to run.
std::string told(const std::vector<std::string>& log, const std::string& mount, const std::string& place) {
    std::map<std::string, int> lines;
    for (std::string line : log) {
        for (std::size_t at = line.find(mount); at != std::string::npos; at = line.find(mount))
            line.replace(at, mount.size(), place);
        line = std::regex_replace(line, std::regex("(sensor|motor)[0-9]+/[a-z0-9_]+"), "$1N/...");
        ++lines[std::regex_replace(line, std::regex("[|\n]"), " ")];
    }
    std::vector<std::string> shown;
    for (const auto& [line, count] : lines)
        shown.push_back(fmt::format("`{}`{}", line, count > 1 ? " again and again" : ""));
    return fmt::format("{}", fmt::join(shown, "; "));
}

// Drives with a command that changes all the time, so that the motors' nodes are written, and lights that do.
bool drive(DrivenRobot& driven, double seconds, const std::function<bool()>& until = nullptr) {
    const double end = driven.system.now().seconds + seconds;
    auto* leds = dynamic_cast<InPort<std::vector<bool>>*>(driven.robot->find_in_port("leds"));
    auto* led_bits = dynamic_cast<InPort<std::vector<bool>>*>(driven.robot->find_in_port("led4bit_in"));
    for (int i = 0; driven.system.now().seconds < end; ++i) {
        const bool on = i % 2 == 0;
        for (auto* lights : {leds, led_bits}) {
            if (lights != nullptr) lights->inject(std::vector<bool>{on, on, on, on});
        }
        driven.run(0.025, {.vx = 0.1, .va = on ? 0.1 : -0.1});
        if (until && until()) return true;
    }
    return !until;
}

// One row: the robot drives, the device fails for a while, and is well again.
template <class Fake, class Driven>
std::string row(Fake& fake, Driven& driven, const FailingDevice& device, const std::string& fault) {
    const auto speak = [&] {
        return std::all_of(device.ports.begin(), device.ports.end(),
                           [&](const auto& port) { return driven.speaks(port); });
    };
    REQUIRE(drive(driven, 10, [&] { return fake.moves() && speak(); }));
    drive(driven, told_back);
    driven.log.clear();
    const bool is_cable = fault == "unplugged";
    if (is_cable) {
        REQUIRE(fake.say("unplug " + device.node).empty());
    } else {
        fake.fault(device.node, fault);
    }
    drive(driven, fault == "zeros" || fault == "frozen" ? 2 : device.told_within);
    std::set<bool> moves;
    drive(driven, 1.2, [&] {
        moves.insert(fake.moves());
        return false;
    });
    const char* wheels = moves.size() > 1 ? "stop and go" : *moves.begin() ? "go on" : "stand";
    std::string silent;
    for (const std::string& port : device.ports) {
        if (!driven.speaks(port)) silent += (silent.empty() ? "`" : ", `") + port + "`";
    }
    const std::string said = told(driven.log, fake.mount(), device.robot == "mouse" ? "/dev" : "");
    if (is_cable) {
        REQUIRE(fake.say("plug " + device.node).empty());
    } else {
        fake.fault(device.node, "none");
    }
    const bool back = drive(driven, 3 + device.told_within, [&] { return fake.moves() && speak(); });
    return fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", device.robot, device.device, fault, wheels,
                       silent.empty() ? "all speak" : silent + " silent", said, back ? "as before" : "stays so");
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
    // Its pictures come 30 times a second, some of them late.
    bool speaks(std::string_view port) const {
        return port == "eye.out" ? system.now().seconds - std::as_const(*eye).find_out_port("out")->tm() < 0.5
                                 : DrivenMouse::speaks(port);
    }
    Component* eye = nullptr;
};

// The rows of a device as the page has them.
std::string rows_of(const FailingDevice& device, const std::string& text) {
    const std::string begin = fmt::format("| {} | {} | ", device.robot, device.device);
    std::string rows;
    for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
        const std::size_t end = text.find('\n', at) + 1;
        rows += text.substr(at, end - at);
        at = end;
    }
    return rows;
}

void compare(const FailingDevice& device, const std::string& rows) {
    std::string text = *read_whole(page, page);
    const std::string there = rows_of(device, text);
    if (std::getenv("NEZUMI_RENEW") != nullptr && rows != there) {
        std::size_t at = text.find("<!-- end faults -->");
        if (!there.empty()) {
            at = text.find(there);
            REQUIRE(at != std::string::npos);
            text.erase(at, there.size());
        }
        std::ofstream(page, std::ios::binary) << text.insert(at, rows);
    }
    INFO("run this test with NEZUMI_RENEW=1 in the environment to bring the page up to date");
    CHECK(rows == there);
}

const std::vector<std::string> when_written{"missing", "denied", "eio", "enodev", "hang"};
const std::vector<std::string> when_read{"missing", "denied", "eio", "enodev", "hang", "garbage", "frozen"};
const std::vector<std::string> when_counted{"missing", "denied", "eio",   "enodev", "hang",
                                            "garbage", "frozen", "zeros", "tear"};

}  // namespace

TEST_CASE("each fault of each device of the mouse in motion comes to what the page says",
          "[hw][mouse][fakes][safety][.][matrix]") {
    const std::vector<std::string> odometry{"current_pose_out", "current_velocity_out"};
    const auto device = GENERATE_COPY(values<FailingDevice>({
        {"mouse", "left motor", "rtmotor_raw_l0", when_written, odometry},
        {"mouse", "right motor", "rtmotor_raw_r0", when_written, odometry},
        {"mouse", "motor power", "rtmotoren0", when_written, odometry},
        {"mouse", "left counter", "rtcounter_l0", when_counted, odometry},
        {"mouse", "right counter", "rtcounter_r0", when_counted, odometry},
        {"mouse",
         "distance sensors",
         "rtlightsensor0",
         {"missing", "denied", "eio", "enodev", "hang", "garbage", "frozen", "zeros"},
         {"ir_sensor_out", "ir_sensor_metre_out"}},
        {"mouse", "switch 1", "rtswitch1", when_read, {"switch3bit_out"}},
        {"mouse", "light 0", "rtled0", when_written, {}},
        {"mouse", "buzzer", "rtbuzzer0", when_written, {}},
    }));
    INFO(device.device);
    FakeMouse fake;
    std::string rows;
    DrivenMouse driven(fake);
    for (const std::string& fault : device.faults) {
        rows += row(fake, driven, device, fault);
    }
    compare(device, rows);
}

TEST_CASE("each fault of a mouse's camera in motion comes to what the page says",
          "[hw][mouse][camera][fakes][safety][.][matrix]") {
    const FailingDevice device{.robot = "mouse",
                               .device = "camera",
                               .node = "video0",
                               .faults = {"unplugged", "denied", "busy", "eio", "enodev", "hang", "silent"},
                               .ports = {"eye.out"},
                               .told_within = VideoCamera::slowest_opening + 2};
    FakeMouse fake;
    SeeingMouse driven(fake);
    std::string rows;
    for (const std::string& fault : device.faults) rows += row(fake, driven, device, fault);
    compare(device, rows);
}

TEST_CASE("each fault of each device of the EV3 in motion comes to what the page says",
          "[hw][ev3][fakes][safety][.][matrix]") {
    const std::vector<std::string> all{"missing", "denied", "eio", "timeout", "hang", "garbage"};
    const std::vector<std::string> cable{"unplugged"};
    const std::vector<std::string> odometry{"odometry", "current_vel"};
    const auto device = GENERATE_COPY(values<FailingDevice>({
        {"EV3", "left motor", "outB", cable, odometry},
        {"EV3", "left motor's command", "outB/command", all, odometry},
        {"EV3", "left motor's speed", "outB/speed_sp", all, odometry},
        {"EV3", "left motor's position", "outB/position", all, odometry},
        {"EV3", "right motor", "outC", cable, odometry},
        {"EV3", "arm's motor", "outA", cable, {}},
        {"EV3", "right touch sensor", "in3", cable, {"touch"}},
        {"EV3", "right touch sensor's value", "in3/value0", all, {"touch"}},
        {"EV3", "ultrasonic sensor", "in4", cable, {"ultrasonic"}},
        {"EV3", "ultrasonic sensor's value", "in4/value0", all, {"ultrasonic"}},
        {"EV3", "gyro", "in2", cable, {"gyro", "gyro_rate"}},
        {"EV3", "gyro's value", "in2/value0", all, {"gyro", "gyro_rate"}},
        {"EV3", "colour sensor", "in5", cable, {"color", "light_reflect"}},
        {"EV3", "colour sensor's value", "in5/value0", all, {"color", "light_reflect"}},
        {"EV3", "battery", "battery", all, {}},
        {"EV3", "left red light", "led0:red", all, {}},
        {"EV3", "screen", "fb0", all, {}},
    }));
    INFO(device.device);
    FakeEv3 fake;
    fake.say("press right 1");
    fake.say("press left 1");
    std::string rows;
    DrivenEv3 driven(fake);
    for (const std::string& fault : device.faults) {
        rows += row(fake, driven, device, fault);
    }
    compare(device, rows);
}
