// `nezumi run --hw`: which robots and devices of a system are the real ones.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/live/running_system.hpp"
#include "engine/system/system_spec.hpp"
#include "hw/device/roots.hpp"

namespace nezumi::cli {

/// The slowest tick [Hz] that drives a real robot: its guard counts on the next one.
inline constexpr double slowest_hardware_rate = 10;

struct Hardware {
    std::vector<std::string> robots;  ///< and devices that are real; empty: all that the file does not keep simulated
    std::string dev_root = "/dev";
    std::string sys_root = "/sys";
    bool twins = false;      ///< each real robot has its twin
    std::string device_log;  ///< is written; "": none
    std::string played_log;  ///< stands for the robots; "": none
};

/// Gives the real robots of a system the drivers that their models name, and its real devices the usual one of their
/// type: those of these names, or all. What a robot carries is as real as the robot. An error, at the line that is
/// wrong, when there is no such name, when a model has no driver, when nothing is left that is real, or when the tick
/// is too slow.
Expected<void> choose_drivers(SystemSpec& spec, const std::vector<std::string>& names,
                              const decltype(Makers::components)& drivers);

/// The number of the computer that a robot has, as its firmware tells it: "" when it does not.
std::string serial_number(const std::string& sys_root);

/// Gives the real robots of a system their own descriptions, where they have been calibrated. An error when a file of a
/// calibration can't be read, or is another robot's.
Expected<void> use_calibrations(SystemSpec& spec, const LiveOptions& live, const std::optional<std::string>& serial);

/// Has systems made with real robots, at real time, that are reached by `roots`.
void use_hardware(LiveOptions& live, const Hardware& hardware, const hw::DeviceRoots& roots);

}  // namespace nezumi::cli
