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
    /// Serial number of the computer that drives the robot: "" if this computer has none; nothing without a computer.
    std::optional<std::string> serial;
};

/// Gives a robot a separate description with the values of its calibration file. Does nothing if there is no such file
/// and `use.is_needed` is false. Errors: those of the file, or the file belongs to another robot.
Expected<void> use_calibration(SystemSpec& spec, RobotEntry& robot, const Project& project, const CalibrationUse& use);

/// Applies the calibrations of all robots with `calibrated = true`. For these, a missing calibration is an error.
Expected<void> use_asked_calibrations(SystemSpec& spec, const Project& project);

}  // namespace nezumi
