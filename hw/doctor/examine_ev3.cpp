// The brick's devices by their classes in sysfs, and its battery.
#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <utility>

#include "hw/doctor/examine.hpp"
#include "hw/doctor/machine_queries.hpp"
#include "hw/ev3/sensors.hpp"
#include "hw/guard/lease.hpp"

namespace nezumi::hw {
namespace {

using enum Finding::State;

double volts(const std::string& path) {
    const std::string text = first_line(path);
    double microvolts = 0;
    std::from_chars(text.data(), text.data() + text.size(), microvolts);
    return microvolts * 1e-6;
}

class Brick {
public:
    Brick(const MachineRoots& roots, Findings& findings)
        : sys_(roots.devices.sys), proc_(roots.proc), findings_(findings) {}

    void examine() {
        look_at_motors();
        look_at_sensors();
        look_at_battery();
    }

private:
    void say(std::string check, Finding::State state, std::string found, std::string advice = "") {
        findings_.push_back({std::move(check), state, std::move(found), std::move(advice)});
    }

    void look_at_motors() {
        const std::string folder = sys_ + "/class/tacho-motor";
        int large = 0;
        std::vector<std::string> there, commands;
        for (const std::string& name : names_in(folder)) {
            const std::string motor = fmt::format("{}/{}", folder, name), driver = first_line(motor + "/driver_name");
            there.push_back(fmt::format("{} at {}", driver, port_of(first_line(motor + "/address"))));
            if (driver == "lego-ev3-l-motor") ++large;
            commands.push_back(motor + "/command");
        }
        if (there.empty()) {
            say("motors", wrong, "no motor is plugged in", "plug the wheels' large motors into B and C");
            return;
        }
        for (const std::string& command : commands) {
            const int code = opening_fails_with(command, Node::Access::write);
            if (code != EACCES && code != EPERM) continue;
            const std::string group = group_that_may(command);
            return say("permissions", wrong, "this user has no permission to use the motors",
                       group.empty() ? "sudo adduser $USER ev3dev, then log in again" : group);
        }
        for (const Holder& holder : holders_of(commands, proc_))
            say("programs", wrong,
                fmt::format("{} (process {}) has {} open", holder.name.empty() ? "a program" : holder.name,
                            holder.process, listed(holder.files)),
                fmt::format("end this program before you drive the robot: kill {}", holder.process));
        if (const auto lease = Lease::take("ev3", folder); !lease) {
            const std::string text = lease.error().message;
            const std::size_t colon = text.rfind(": ");
            say("programs", wrong, text.substr(0, colon), colon == text.npos ? "" : text.substr(colon + 2));
        }
        if (large < 2) {
            say("motors", wrong, fmt::format("{} of 2 large motors are plugged in: {}", large, listed(there)),
                "plug the wheels' large motors into B and C, and look at their cables");
        } else {
            say("motors", good, listed(there));
        }
    }

    void look_at_sensors() {
        const std::string folder = sys_ + "/class/lego-sensor";
        std::vector<std::string> there;
        for (const std::string& name : names_in(folder))
            there.push_back(fmt::format("{} at {}", first_line(fmt::format("{}/{}/driver_name", folder, name)),
                                        port_of(first_line(fmt::format("{}/{}/address", folder, name)))));
        if (there.empty()) {
            say("sensors", note, "none is plugged in", "plug in those that your behaviours use");
        } else {
            say("sensors", good, listed(there));
        }
    }

    void look_at_battery() {
        const std::string folder = sys_ + "/class/power_supply/lego-ev3-battery";
        const double now = volts(folder + "/voltage_now"), design = volts(folder + "/voltage_min_design");
        const double least = design > 0 ? design : Battery::least;
        if (now == 0) return say("battery", note, "its voltage is unknown");
        const std::string text = fmt::format("{:.1f} V", now);
        if (now < least) {
            say("battery", wrong, fmt::format("{}: below {:.1f} V the robot does not drive", text, least),
                "charge the battery, or put in fresh batteries");
        } else {
            say("battery", good, text);
        }
    }

    const std::string sys_, proc_;
    Findings& findings_;
};

}  // namespace

void examine_ev3(const MachineRoots& roots, Findings& findings) { Brick(roots, findings).examine(); }

}  // namespace nezumi::hw
