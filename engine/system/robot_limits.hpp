// The limits of a robot: those of the system file; for a real robot at most those of the robot's description.
#pragma once

#include <string>

#include "engine/system/system_spec.hpp"
#include "engine/world/robot_spec.hpp"

namespace nezumi {

/// The limits of a robot with this drive: those of the system file, otherwise those of the model. The limits of a real
/// robot are at most those of its model and its hardware.
Limits limits_of(const RobotEntry& entry, const DriveSpec& drive);

/// A line about limits of a real robot that are lower than in its system's file, with both numbers and how to raise
/// them; "" if there are none.
std::string lowered_limits(const RobotEntry& entry, const DriveSpec& drive);

}  // namespace nezumi
