// Lets a robot of a system that was read differ from what its file says.
#pragma once

#include <string>

#include "bindings/lua/files/file_fields.hpp"
#include "bindings/lua/files/file_value.hpp"
#include "engine/project/project.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// What the system says of this robot, with these fields of a robot file over it.
Expected<Value> changes_with(const RobotEntry& robot, const Value& changes, const Project& project);

/// Puts these fields of a robot file over what the system says of the robot of this name; a calibration it has is used
/// again. What is wrong with them is said to `check`. An error when there is no such robot, which names the nearest.
Expected<void> change_robot(SystemSpec& spec, const std::string& robot, const Value& changes, FieldCheck& check,
                            const Project& project);

}  // namespace nezumi
