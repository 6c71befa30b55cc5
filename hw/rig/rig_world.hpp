// A test rig for real robots, as a world: it observes, pushes and moves the robots over one socket per robot.
#pragma once

#include <map>
#include <string>

#include "engine/base/error.hpp"
#include "engine/system/rig.hpp"

namespace nezumi::hw {

/// Connects to the rig's Unix stream sockets, one per real robot, and moves the robots to the poses in the system file.
/// `sockets`: the paths, by the robot's name. A request is one line. The answer is some lines, then a line with only a
/// dot. If a request is refused, the answer is the reason.
///
///     truth                    X Y HEADING VX VY VA HEIGHT TILT: units as `Truth`
///     touched                  obstacles touched since the last request `touched`, such as "box 1"; empty if none
///     place X Y HEADING        moves the robot to this pose, and leaves it at rest
///     disturb VX VY VA         forces these velocities on the robot; "-" leaves one of them free
///     press SENSOR 1|0         presses (1) or releases (0) a button of the robot
///
/// If a rig does not answer within a second, the world fails.
Expected<Rig> open_rig(const SystemSpec& spec, const std::map<std::string, std::string>& sockets);

}  // namespace nezumi::hw
