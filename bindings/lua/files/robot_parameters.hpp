// Sets initial values of robot parameters in a system that has been read.
#pragma once

#include <string>

#include "engine/project/project.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// The field of a robot file for a parameter with this value: `{ actuators = { NAME = { speed = VALUE } } }`. The error
/// names the nearest parameter, or the limit that the value exceeds.
Expected<Value> field_of_parameter(const RobotSpec& robot, const std::string& parameter, const Value& value);

/// Sets the initial value of a parameter of the robot with this name. An error has the location `place`.
Expected<void> set_robot_parameter(SystemSpec& spec, const std::string& robot, const std::string& parameter,
                                   const Value& value, const Place& place, const Project& project);

/// Sets the initial values of the robot's parameters to those of `from`, a robot of the system `saved`.
Expected<void> take_robot_parameters(SystemSpec& spec, const std::string& robot, const SystemSpec& saved,
                                     const RobotEntry& from, const Project& project);

}  // namespace nezumi
