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

/// Where the calibration of the robot of this name is, beside a system's file.
std::filesystem::path calibration_path(const std::filesystem::path& system, std::string_view robot);

/// Reads a calibration. Errors say file and line; one that is torn in the middle is one of them. `shown` is the file's
/// name in errors.
Expected<Calibration> read_calibration_text(std::string_view text, const std::string& shown, const Project& project);

/// As a file has it.
std::string write_calibration(const Calibration& calibration);

/// How a robot of a system gets the description that its calibration makes of its model.
struct CalibrationUse {
    bool is_needed = false;  ///< that there is no calibration is an error
    /// Of the computer that drives it: "" where that has none; nothing where none does.
    std::optional<std::string> serial;
};

/// Gives a robot of the system its own description, once. Nothing is done where it has no calibration and needs none.
/// Errors are those of the file, or say that it is another robot's.
Expected<void> use_calibration(SystemSpec& spec, RobotEntry& robot, const Project& project, const CalibrationUse& use);

/// The same for each robot of the system that says `calibrated = true`: it needs one.
Expected<void> use_asked_calibrations(SystemSpec& spec, const Project& project);

}  // namespace nezumi
