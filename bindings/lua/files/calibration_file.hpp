// Reads and writes calibration files: `calibration { ... }` in `ROBOT.calibration.lua` beside the system.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "engine/project/project.hpp"
#include "engine/system/system_spec.hpp"
#include "engine/world/calibration.hpp"

namespace nezumi {

/// The path of a robot's calibration, in the folder of a system file.
std::filesystem::path calibration_path(const std::filesystem::path& system, std::string_view robot);

/// Reads a calibration. Errors have file and line; an incomplete file is an error. `shown` is the file's name in
/// errors.
Expected<Calibration> read_calibration_text(std::string_view text, const std::string& shown, const Project& project);

/// The text of a calibration file.
std::string write_calibration(const Calibration& calibration);

/// Options for applying a calibration to a robot of a system.
struct CalibrationUse {
    bool is_needed = false;  ///< a missing calibration is an error
    /// Serial number of the computer that drives it: "" if it has none; nothing if no computer drives it.
    std::optional<std::string> serial;
};

/// Applies its calibration to a robot, which gets its own description. Does nothing if there is no calibration and none
/// is needed. Errors are those of the file, or say that it belongs to another robot.
Expected<void> use_calibration(SystemSpec& spec, RobotEntry& robot, const Project& project, const CalibrationUse& use);

/// Applies the calibration of each robot of the system with `calibrated = true`, which needs one.
Expected<void> use_asked_calibrations(SystemSpec& spec, const Project& project);

}  // namespace nezumi
