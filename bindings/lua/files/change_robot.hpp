// Changes a robot of a system that has been read.
#pragma once

#include <string>

#include "engine/project/project.hpp"
#include "engine/records/fields.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// The changes of the system file to this robot, overridden by the fields of `changes`.
Expected<Value> changes_with(const RobotEntry& robot, const Value& changes, const Project& project);

/// Overrides the description of the robot with this name by these fields of a robot file, and applies its calibration
/// again. Mistakes in the fields go to `check`. The error about an unknown robot suggests the most similar name.
Expected<void> change_robot(SystemSpec& spec, const std::string& robot, const Value& changes, FieldCheck& check,
                            const Project& project);

}  // namespace nezumi
