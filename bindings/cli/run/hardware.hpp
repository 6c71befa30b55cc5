// `nezumi run --hw`: chooses the real robots and devices of a system.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/live/running_system.hpp"
#include "engine/system/system_spec.hpp"
#include "hw/device/roots.hpp"

namespace nezumi::cli {

/// The slowest tick rate [Hz] for a real robot: its guard needs regular ticks.
inline constexpr double slowest_hardware_rate = 10;

struct Hardware {
    std::vector<std::string> robots;  ///< real robots and devices; empty: all that the file allows
    std::string dev_root = "/dev";
    std::string sys_root = "/sys";
    bool twins = false;      ///< each real robot has a simulated twin
    std::string device_log;  ///< the device log to write; "": none
    std::string played_log;  ///< the device log that replaces the robots; "": none
};

/// Makes robots and devices of a system real: those in `names`, or all if `names` is empty. A robot gets the driver of
/// its model, a device the default driver of its type. A component on a robot is real if the robot is. Fails, with the
/// line, for an unknown name, a model without driver, if nothing is real, or if the tick rate is too low.
Expected<void> choose_drivers(SystemSpec& spec, const std::vector<std::string>& names,
                              const decltype(Makers::components)& drivers);

/// The serial number of the robot's computer, from its firmware; "" if unknown.
std::string serial_number(const std::string& sys_root);

/// Gives the real robots of a system their calibrated descriptions. Fails if a calibration file can't be read or
/// belongs to another robot.
Expected<void> use_calibrations(SystemSpec& spec, const LiveOptions& live, const std::optional<std::string>& serial);

/// Sets up real robots, with their device files under `roots`, and the real-time clock.
void use_hardware(LiveOptions& live, const Hardware& hardware, const hw::DeviceRoots& roots);

}  // namespace nezumi::cli
