// Reads acts for simulated robots and markers from Lua.
#pragma once

#include <lua.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/live/objects.hpp"
#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"
#include "engine/system/act_fields.hpp"
#include "engine/system/system.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

/// A pose, `{ x =, y =, heading = }` or `{ position = { x =, y = }, heading = }`; omitted fields are 0. Raises no Lua
/// error.
Expected<Pose2D> read_pose(lua_State* L, int index);
/// Velocities to force on a robot, `{ vx =, vy =, va = }`; omitted ones stay free. `kind` is one of
/// `Describe<VelocityConstraint>::kinds`. Raises no Lua error.
Expected<VelocityConstraint> read_velocity_constraint(lua_State* L, int index,
                                                      unsigned kind = Describe<VelocityConstraint>::at_once);

/// The names of the arena's markers, and of its movable boxes and cylinders.
std::vector<std::string> marker_names(const System& system);
std::vector<std::string> thing_names(const System& system);
/// The act that moves the robot, marker or object at index `thing` (an object or its name, as in "box 2") of `current`
/// to the pose at index `pose`. A marker takes `{ x =, y =, z =, heading = }` [m, rad], an object `{ x =, y =, heading
/// = }`; omitted fields stay as they are. The error names the nearest robot, marker or field. Raises no Lua error.
struct TeleportOf {
    RunningSystem* live;
    Act act;
};
Expected<TeleportOf> read_teleport(const Objects& objects, RunningSystem& current, lua_State* L, int thing, int pose);

}  // namespace nezumi
