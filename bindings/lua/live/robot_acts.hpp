// What can be done to a simulated robot from outside of it, by people and scenarios.
#pragma once

#include <lua.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/live/objects.hpp"
#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"
#include "engine/system/system.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

/// The robot that this component is, in a world that knows the truth; else why not.
Expected<Robot*> simulated_robot(const System& system, Component& component);

/// A pose as people write it, `{ x =, y =, heading = }` or `{ position = { x =, y = }, heading = }`; what is left out
/// is 0. Raises no Lua error.
Expected<Pose2D> read_pose(lua_State* L, int index);
/// Speeds to force on a robot, `{ vx =, vy =, va = }`; what is left out stays free. Raises no Lua error.
Expected<Push> read_push(lua_State* L, int index);

/// Puts the robot elsewhere, at rest.
Expected<void> teleport(System& system, Component& robot, const Pose2D& pose);
/// The names of the arena's markers.
std::vector<std::string> marker_names(const System& system);
/// The same for what is at `thing`: a robot or its name, or the name of a marker of `current`, the world that names
/// mean; the pose is at `pose`. A marker is carried to `{ x =, y =, z =, heading = }` [m, rad], and what is left out
/// stays as it is. The error names the nearest robot, marker or field. Raises no Lua error.
Expected<void> teleport(const Objects& objects, System& current, lua_State* L, int thing, int pose);
/// A hand forces these speeds until the next call; an empty push lets go.
Expected<void> disturb(System& system, Component& robot, const Push& push);
/// Presses or lets go of a button or touch sensor by its name; the error names the nearest.
Expected<void> press(System& system, Component& robot, std::string_view sensor, bool pressed);

}  // namespace nezumi
