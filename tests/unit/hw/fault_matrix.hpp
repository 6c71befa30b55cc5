// One device of a moving robot with one fault: the robot's reaction, its messages and its recovery. The page's table
// must agree.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "engine/base/whole_file.hpp"
#include "hw/device/health.hpp"
#include "tests/unit/hw/fake_robot_rig.hpp"

namespace nezumi::hw {

/// Uses a device in a step of 25 ms. Returns false if the robot must stand meanwhile.
using Use = bool (*)(DrivenRobot& driven, FakeRobot& fake, int step);

/// A device of a robot: its failing node, and the ports that depend on it.
struct FailingDevice {
    std::string robot, device, node;
    std::vector<std::string> faults;
    std::vector<std::string> ports;
    double told_within = 1;   ///< [s] latest time of the report of a failure
    Use use = nullptr;        ///< during the fault and after it; null: the robot drives and its lights blink
    bool leaves_mark = true;  ///< true if `use` is visible in the fake's log or frame when it works
    std::string mode{};       ///< set by another program
    /// For faults that the fake does not have: starts one, or ends it ("none").
    std::function<void(const std::string& fault)> set{};
};

/// [s] latest time of the report that a device works again.
inline constexpr double told_back = Health::proven_after + 0.5;

/// The sorted messages without parts that differ from run to run. `places`: folders and their replacements.
inline std::string told(const std::vector<std::string>& log, const std::map<std::string, std::string>& places) {
    std::map<std::string, int> lines;
    for (std::string line : log) {
        for (const auto& [folder, shown] : places) {
            for (std::size_t at = line.find(folder); at != line.npos; at = line.find(folder))
                line.replace(at, folder.size(), shown);
        }
        line = std::regex_replace(line, std::regex("(sensor|motor)[0-9]+/[a-z0-9_]+"), "$1N/...");
        // An unplugged device's file also vanishes as soon as it is searched for.
        line = std::regex_replace(line, std::regex("file or directory: it is unplugged: look"),
                                  "device: it is unplugged: look");
        ++lines[std::regex_replace(line, std::regex("[|\n]"), " ")];
    }
    std::vector<std::string> shown;
    for (const auto& [line, count] : lines)
        shown.push_back(fmt::format("`{}`{}", line, count > 1 ? " again and again" : ""));
    return fmt::format("{}", fmt::join(shown, "; "));
}

/// Drives with a command that changes all the time, so that the motors' nodes are written, and lights that do.
template <class Fake, class Driven>
bool drive(Fake& fake, Driven& driven, double seconds, Use use, const std::function<bool()>& until = nullptr) {
    const double end = driven.system.now().seconds + seconds;
    auto* leds = dynamic_cast<InPort<std::vector<bool>>*>(driven.robot->find_in_port("leds"));
    auto* led_bits = dynamic_cast<InPort<std::vector<bool>>*>(driven.robot->find_in_port("led4bit_in"));
    for (int i = 0; driven.system.now().seconds < end; ++i) {
        const bool on = i % 2 == 0;
        for (auto* lights : {leds, led_bits}) {
            if (lights != nullptr) lights->inject(std::vector<bool>{on, on, on, on});
        }
        const bool drives = use == nullptr || use(driven, fake, i);
        driven.run(0.025, drives ? Velocity2D{.vx = 0.1, .va = on ? 0.1 : -0.1} : Velocity2D{});
        if (until && until()) return true;
    }
    return !until;
}

inline void set_fault(FakeRobot& fake, const FailingDevice& device, const std::string& fault) {
    if (device.set) return device.set(fault);
    if (fault == "unplugged") {
        REQUIRE(fake.say("unplug " + device.node).empty());
    } else if (fault == "low") {
        REQUIRE(fake.say("battery 5000000").empty());
    } else if (fault == "mode") {
        REQUIRE(fake.say("mode " + device.node + " " + device.mode).empty());
    } else if (fault == "reload" || fault == "signed") {
        REQUIRE(fake.say(fault).empty());
    } else {
        fake.fault(device.node, fault);
    }
}

inline void end_fault(FakeRobot& fake, const FailingDevice& device, const std::string& fault) {
    if (device.set) return device.set("none");
    if (fault == "unplugged") {
        REQUIRE(fake.say("plug " + device.node).empty());
    } else if (fault == "low") {
        REQUIRE(fake.say("battery 7900000").empty());
    } else if (fault != "mode" && fault != "reload" && fault != "signed") {
        fake.fault(device.node, "none");
    }
}

/// The last effect of using a device: its last successful write, or the screen's picture.
inline std::string mark_of(FakeRobot& fake, const FailingDevice& device) {
    if (device.node == "fb0") return fake.say("frame");
    std::string last;
    std::istringstream lines(fake.say("log"));
    for (std::string line; std::getline(lines, line);) {
        const bool is_its =
            line.find(" " + device.node + " ") != line.npos || line.find(" " + device.node + "/") != line.npos;
        if (is_its && line.find(" -") == line.npos) last = line;
    }
    return last;
}

/// One row: the robot drives, the device fails for a while and works again.
template <class Fake, class Driven>
std::string row(Fake& fake, Driven& driven, const FailingDevice& device, const std::string& fault,
                const std::map<std::string, std::string>& places) {
    const auto speak = [&] {
        return std::all_of(device.ports.begin(), device.ports.end(),
                           [&](const auto& port) { return driven.speaks(port); });
    };
    REQUIRE(drive(fake, driven, 10, nullptr, [&] { return fake.moves() && speak(); }));
    drive(fake, driven, told_back, nullptr);
    driven.log.clear();
    set_fault(fake, device, fault);
    drive(fake, driven,
          std::max(device.told_within, fault == "zeros" || fault == "frozen" ? 2.0
                                       : fault == "low"                      ? 3
                                                                             : 0),
          device.use);
    std::set<bool> moves;
    drive(fake, driven, 1.2, nullptr, [&] {
        moves.insert(fake.moves());
        return false;
    });
    const char* wheels = moves.size() > 1 ? "stop and go" : *moves.begin() ? "go on" : "stand";
    std::string silent;
    for (const std::string& port : device.ports) {
        if (!driven.speaks(port)) silent += (silent.empty() ? "`" : ", `") + port + "`";
    }
    std::string said = told(driven.log, places);
    // It is random whether an open node fails first or its path is missing.
    if (fault == "missing") said = std::regex_replace(said, std::regex("no such device"), "no such file or directory");
    if (fault == "reload") {
        // It is random which of a device's nodes is missed first.
        for (const char* node : {"rtled", "rtswitch", "rtcounter_"})
            said = std::regex_replace(said, std::regex(std::string(node) + "[a-z]?[0-9]"), std::string(node) + "...");
        // It is also random whether the loss of motors is noticed by their errors or by their nodes.
        said = std::regex_replace(said, std::regex("`motors: (/dev/|the driver)[^`]*`; "), "");
    }
    // A busy machine delays the guard, and so what is told of it.
    said = std::regex_replace(said, std::regex("`guard of the motors: [^`]*`; |(; )?`guard of the motors: [^`]*`"), "");
    end_fault(fake, device, fault);
    const std::string mark = device.use != nullptr ? mark_of(fake, device) : "";
    if (device.use != nullptr) drive(fake, driven, device.told_within + 1, device.use);
    const bool works = device.use == nullptr || !device.leaves_mark || mark_of(fake, device) != mark;
    const bool back = drive(fake, driven, 3 + device.told_within, nullptr, [&] { return fake.moves() && speak(); });
    return fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", device.robot, device.device, fault, wheels,
                       silent.empty() ? "all speak" : silent + " silent", said,
                       back && works ? "as before" : "stays so");
}

inline const std::string& page_of_faults() {
    static const std::string page = source_root() + "/docs/hardware.md";
    return page;
}

/// The rows of a device as the page has them.
inline std::string rows_of(const FailingDevice& device, const std::string& text) {
    const std::string begin = fmt::format("| {} | {} | ", device.robot, device.device);
    std::string rows;
    for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
        const std::size_t end = text.find('\n', at) + 1;
        rows += text.substr(at, end - at);
        at = end;
    }
    return rows;
}

/// Compares all rows of a device with the page, or updates the page.
inline void compare(const FailingDevice& device, const std::string& rows) {
    const std::string& page = page_of_faults();
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

}  // namespace nezumi::hw
