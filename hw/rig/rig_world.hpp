// A test rig as a world: it sees real robots from outside, pushes them and puts them back, each over a socket.
#pragma once

#include <map>
#include <string>

#include "engine/base/error.hpp"
#include "engine/system/rig.hpp"

namespace nezumi::hw {

/// Connects to the Unix stream sockets of a rig, those of the system's real robots by their names, and puts these
/// robots where the system's file has them. A line goes out, and the answer is lines up to one with a dot alone. What
/// is refused has a line that says why.
///   truth                    X Y HEADING VX VY VA HEIGHT TILT: units as `Truth`
///   touched                  what the robot has touched since this was asked last, as "box 1"; nothing where nothing
///   place X Y HEADING        puts it there, at rest
///   disturb VX VY VA         forces these velocities on it, "-" leaves one free
///   press SENSOR 1|0         presses, lets go
/// A rig that does not answer within a second is the world's breakdown.
Expected<Rig> open_rig(const SystemSpec& spec, const std::map<std::string, std::string>& sockets);

}  // namespace nezumi::hw
