// Lets a robot of a system that was read begin with other values of its parameters.
#pragma once

#include <string>

#include "bindings/lua/files/file_value.hpp"
#include "engine/project/project.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// The field of a robot file that a parameter begins with, at this value: `{ actuators = { NAME = { speed = VALUE } }
/// }`. The error names the nearest parameter, or the bound that the value breaks.
Expected<Value> field_of_parameter(const RobotSpec& robot, const std::string& parameter, const Value& value);

/// Lets the robot of this name begin with this value. An error has the place `place`.
Expected<void> set_robot_parameter(SystemSpec& spec, const std::string& robot, const std::string& parameter,
                                   const Value& value, const Place& place, const Project& project);

/// Lets it begin with the values that `from`, a robot of `saved`, begins with.
Expected<void> take_robot_parameters(SystemSpec& spec, const std::string& robot, const SystemSpec& saved,
                                     const RobotEntry& from, const Project& project);

}  // namespace nezumi
