// A test rig for real robots, as a world: it observes, pushes and moves the robots over one socket per robot.
#pragma once

#include <map>
#include <string>

#include "engine/base/error.hpp"
#include "engine/system/rig.hpp"

namespace nezumi::hw {

/// Connects to the rig's Unix stream sockets, one per real robot by its name, and moves the robots to the poses of the
/// system's file. A request is one line; the answer is lines that end with a line with only a dot. A refused request is
/// answered with the reason.
///
///     truth                    X Y HEADING VX VY VA HEIGHT TILT: units as `Truth`
///     touched                  obstacles touched since the last such request, as "box 1"; empty if none
///     place X Y HEADING        moves the robot there, at rest
///     disturb VX VY VA         forces these velocities on it; "-" leaves one free
///     press SENSOR 1|0         presses or releases
///
/// If a rig does not answer within a second, the world fails.
Expected<Rig> open_rig(const SystemSpec& spec, const std::map<std::string, std::string>& sockets);

}  // namespace nezumi::hw
