// Changes a robot of a system that has been read.
#pragma once

#include <string>

#include "engine/project/project.hpp"
#include "engine/records/fields.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// The changes that the system makes to this robot, with these fields over them.
Expected<Value> changes_with(const RobotEntry& robot, const Value& changes, const Project& project);

/// Puts these fields of a robot file over the description of the robot with this name, and applies its calibration
/// again. Mistakes in the fields go to `check`. The error says that there is no such robot, and names the nearest.
Expected<void> change_robot(SystemSpec& spec, const std::string& robot, const Value& changes, FieldCheck& check,
                            const Project& project);

}  // namespace nezumi
