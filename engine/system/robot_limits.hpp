// What a robot of a system may do: what its file asks for, within what its description allows.
#pragma once

#include <string>

#include "engine/system/system_spec.hpp"
#include "engine/world/robot_spec.hpp"

namespace nezumi {

/// The limits of a robot with this drive. Those of a real one are no more than its description allows the hardware,
/// whatever the system's file asks for.
Limits limits_of(const RobotEntry& entry, const DriveSpec& drive);

/// What a real robot gets less of than its system's file asks for, with both numbers and what raises it, in one line;
/// "" when it gets all of it.
std::string lowered_limits(const RobotEntry& entry, const DriveSpec& drive);

}  // namespace nezumi
