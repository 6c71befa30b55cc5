// Examines the mouse's kernel driver, its device nodes, and the hardware behind them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include "hw/doctor/examine.hpp"
#include "hw/doctor/machine_queries.hpp"
#include "hw/guard/lease.hpp"
#include "hw/raspimouse/advice.hpp"
#include "hw/raspimouse/codec.hpp"

namespace nezumi::hw {
namespace {

using enum Finding::State;

struct MouseNode {
    const char* name;
    Node::Access access;
};
constexpr Node::Access reads = Node::Access::read, writes = Node::Access::write;
constexpr MouseNode all_nodes[] = {
    {"rtmotoren0", writes},  {"rtmotor_raw_l0", writes}, {"rtmotor_raw_r0", writes}, {"rtlightsensor0", reads},
    {"rtcounter_l0", reads}, {"rtcounter_r0", reads},    {"rtswitch0", reads},       {"rtswitch1", reads},
    {"rtswitch2", reads},    {"rtled0", writes},         {"rtled1", writes},         {"rtled2", writes},
    {"rtled3", writes},      {"rtbuzzer0", writes},
};
// Device nodes that other programs often open. Opening the signed counter nodes changes the values of the unsigned
// ones.
constexpr const char* nodes_of_others[] = {"rtcounter_l1", "rtcounter_r1", "rtmotor0"};

constexpr int light_readings = 5;  // number of readings; if all are 0 0 0 0, the sensors do not measure

class Mouse {
public:
    Mouse(const MachineRoots& roots, Findings& findings) : roots_(roots), findings_(findings) {}

    void examine() {
        look_at_driver();
        look_at_holders();
        look_at_nodes();
        if (look_at_lights()) look_at_overlay();
        look_at_counters();
        look_at_i2c_clock();
    }

private:
    void say(std::string check, Finding::State state, std::string found, std::string advice = "") {
        findings_.push_back({std::move(check), state, std::move(found), std::move(advice)});
    }
    std::string node(const char* name) const { return roots_.devices.dev + "/" + name; }

    void look_at_driver() {
        const std::string module = roots_.devices.sys + "/module/rtmouse";
        const std::string version = first_line(module + "/version");
        if (!version.empty()) return say("driver", good, "rtmouse " + version);
        if (!names_in(module).empty()) return say("driver", good, "rtmouse, version unknown");
        if (opening_fails_with(node("rtmotoren0"), writes) != ENOENT)
            return say("driver", note, module + " does not exist, but the driver's device nodes exist");
        say("driver", wrong, "rtmouse is not loaded",
            "sudo modprobe rtmouse; if there is no such module, build it: "
            "https://github.com/rt-net/RaspberryPiMouse");
    }

    void look_at_holders() {
        std::vector<std::string> paths;
        for (const MouseNode& each : all_nodes) paths.push_back(node(each.name));
        for (const char* name : nodes_of_others) paths.push_back(node(name));
        const std::string power = node("rtmotoren0");
        bool is_power_held = false;
        for (const Holder& holder : holders_of(paths, roots_.proc)) {
            for (const std::string& file : holder.files) {
                is_power_held = is_power_held || file == power;
                is_counter_held_ = is_counter_held_ || file.find("rtcounter") != file.npos;
            }
            say("programs", wrong,
                fmt::format("{} (process {}) has {} open", holder.name.empty() ? "a program" : holder.name,
                            holder.process, listed(holder.files)),
                fmt::format("end this program before you drive the robot: kill {}", holder.process));
        }
        if (is_power_held || opening_fails_with(power, writes) != 0) return;
        // A program of another user is not visible in /proc, but its lease is.
        if (const auto lease = Lease::take("raspimouse", power); !lease) {
            const std::string text = lease.error().message;
            const std::size_t colon = text.rfind(": ");
            say("programs", wrong, text.substr(0, colon), colon == text.npos ? "" : text.substr(colon + 2));
        }
    }

    void look_at_nodes() {
        std::vector<std::string> missing, denied;
        std::size_t count = 0;
        for (const MouseNode& each : all_nodes) {
            ++count;
            if (is_counter_held_ && std::string_view(each.name).starts_with("rtcounter")) continue;
            const std::string path = node(each.name);
            switch (const int code = opening_fails_with(path, each.access)) {
                case 0: break;
                case ENOENT:
                case ENODEV:
                case ENXIO: missing.emplace_back(each.name); break;
                case EACCES:
                case EPERM: denied.emplace_back(each.name); break;
                case ETIMEDOUT:
                    say("nodes", wrong, path + " does not answer",
                        "sudo modprobe -r rtmouse, then sudo modprobe rtmouse");
                    break;
                default: {
                    const std::string text = with_mouse_advice({path, code});
                    const std::size_t colon = text.rfind(": ");
                    say("nodes", wrong, text.substr(0, colon), text.substr(colon + 2));
                }
            }
        }
        if (!missing.empty())
            say("nodes", wrong,
                fmt::format("{} of {} are missing in {}: {}", missing.size(), count, roots_.devices.dev,
                            listed(missing)),
                std::all_of(missing.begin(), missing.end(),
                            [](const std::string& name) { return name.starts_with("rtcounter"); })
                    ? std::string("the driver has not found the counters on I2C. ") + counters_on_i2c
                : missing.size() == count
                    ? "load the driver: sudo modprobe rtmouse"
                    : "load the driver again, and look at what dmesg says: sudo modprobe -r rtmouse, "
                      "then sudo modprobe rtmouse");
        if (!denied.empty()) {
            const std::string group = group_that_may(node(denied.front().c_str()));
            say("permissions", wrong, "this user has no permission to use " + listed(denied),
                group.empty() ? rule_advice() : group);
        } else if (missing.empty()) {
            say("nodes", good, fmt::format("all {} can be used", count));
            look_at_rules();
        }
    }

    // If there is no udev rule, the permissions were changed by hand, and the change is lost at the next start.
    void look_at_rules() {
        for (const std::string& folder : roots_.udev) {
            for (const std::string& name : names_in(folder + "/rules.d")) {
                const std::string path = fmt::format("{}/rules.d/{}", folder, name);
                std::ifstream file(path);
                std::stringstream text;
                text << file.rdbuf();
                if (text.str().find("rtmotor") != std::string::npos || text.str().find("\"rt*") != std::string::npos)
                    return say("udev rules", good, path);
            }
        }
        say("udev rules", note,
            "no udev rule gives access to the device nodes: other users have no access, or lose it at the next start",
            rule_advice());
    }

    std::string rule_advice() const {
        return fmt::format(
            "sudo cp {} /etc/udev/rules.d/, then sudo udevadm control --reload, sudo udevadm trigger, "
            "and sudo adduser $USER dialout",
            roots_.rules.empty() ? "60-nezumi.rules" : roots_.rules);
    }

    // Returns true if the cause of missing values must be found.
    bool look_at_lights() {
        LightValues values{};
        for (int i = 0; i < light_readings; ++i) {
            const auto said = ask(node("rtlightsensor0"));
            if (!said) {
                if (said.error() == ETIMEDOUT) {
                    say("light sensors", wrong, "they do not answer",
                        "sudo modprobe -r rtmouse, then sudo modprobe rtmouse");
                } else if (said.error() == EIO) {
                    say("light sensors", wrong, "reading them fails",
                        "look at what dmesg says, and at the boards' connector");
                }
                return true;
            }
            const auto read = decode_lights(*said);
            if (!read) {
                say("light sensors", wrong, fmt::format("expected 4 numbers, got '{}'", shown(*said)),
                    "is rtlightsensor0 the node of another driver?");
                return false;
            }
            values = *read;
            if (values == LightValues{}) continue;
            say("light sensors", good, fmt::format("{}", fmt::join(values, " ")));
            return false;
        }
        say("light sensors", wrong, "they always give 0 0 0 0: that is not a measurement",
            "switch SPI on (see the finding 'overlay'), and check the boards' connector");
        return true;
    }

    void look_at_overlay() {
        int major = 0, minor = 0;
        const std::string release = first_line(roots_.proc + "/sys/kernel/osrelease");
        std::sscanf(release.c_str(), "%d.%d", &major, &minor);
        for (const std::string& name : names_in(roots_.devices.sys + "/bus/spi/devices")) {
            const std::string its = first_line(fmt::format("{}/bus/spi/devices/{}/modalias", roots_.devices.sys, name));
            if (its.find("mcp320") != its.npos) return say("overlay", good, fmt::format("{} is {}", name, its));
        }
        const bool needs_overlay = std::pair(major, minor) >= std::pair(5, 16);
        say("overlay", wrong, "the converter of the light sensors is not on the SPI bus",
            fmt::format(
                "write dtparam=spi=on{}{} into /boot/firmware/config.txt (/boot/config.txt on older systems), and "
                "restart",
                needs_overlay ? " and " : "", needs_overlay ? light_sensor_overlay : ""));
    }

    void look_at_counters() {
        const bool has_bus = !names_in(roots_.devices.sys + "/bus/i2c/devices").empty();
        const std::string i2c =
            "write dtparam=i2c_arm=on into /boot/firmware/config.txt (/boot/config.txt on older "
            "systems), and restart; then i2cdetect -y 1 shows 10 and 11";
        if (is_counter_held_) return say("wheel counters", note, "another program uses them: not tested");
        std::vector<std::string> said;
        for (const char* name : {"rtcounter_l0", "rtcounter_r0"}) {
            const auto text = ask(node(name));
            const auto count = text ? decode_counter(*text) : std::nullopt;
            if (count) said.push_back(std::to_string(*count));
        }
        if (said.size() == 2) return say("wheel counters", good, fmt::format("{} left, {} right", said[0], said[1]));
        if (has_bus) {
            say("wheel counters", wrong, "they can't be read",
                "look at what dmesg says, and whether i2cdetect -y 1 shows 10 and 11");
        } else {
            say("I2C", wrong, "it is off, and the wheel counters need it", i2c);
        }
    }

    // The clock is a value of the device tree: four bytes, big endian. It may be missing.
    void look_at_i2c_clock() {
        const std::string path = roots_.devices.sys + "/bus/i2c/devices/i2c-1/of_node/clock-frequency";
        std::ifstream file(path, std::ios::binary);
        std::array<unsigned char, 4> bytes{};
        if (!file.read(reinterpret_cast<char*>(bytes.data()), bytes.size())) return;
        unsigned hertz = 0;
        for (const unsigned char byte : bytes) hertz = hertz << 8U | byte;
        if (hertz <= counters_i2c_clock) return say("I2C clock", good, fmt::format("{} Hz", hertz));
        say("I2C clock", wrong,
            fmt::format("{} Hz: the manufacturer of the wheel counters allows at most {} Hz, else readings fail", hertz,
                        counters_i2c_clock),
            fmt::format("write dtparam=i2c_baudrate={} into /boot/firmware/config.txt (/boot/config.txt on older "
                        "systems), and restart",
                        counters_i2c_clock));
    }

    const MachineRoots& roots_;
    Findings& findings_;
    bool is_counter_held_ = false;
};

}  // namespace

void examine_mouse(const MachineRoots& roots, Findings& findings) { Mouse(roots, findings).examine(); }

}  // namespace nezumi::hw
