// Reads what is to be done to simulated robots and markers from Lua.
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

/// A pose as people write it, `{ x =, y =, heading = }` or `{ position = { x =, y = }, heading = }`; what is left out
/// is 0. Raises no Lua error.
Expected<Pose2D> read_pose(lua_State* L, int index);
/// Speeds to force on a robot, `{ vx =, vy =, va = }`, what is left out stays free, as one of
/// `Describe<VelocityConstraint>::kinds` takes them. Raises no Lua error.
Expected<VelocityConstraint> read_velocity_constraint(lua_State* L, int index,
                                                      unsigned kind = Describe<VelocityConstraint>::at_once);

/// The names of the arena's markers, and of the boxes and cylinders that can be carried.
std::vector<std::string> marker_names(const System& system);
std::vector<std::string> thing_names(const System& system);
/// The act of carrying what is at `thing`: a robot or its name, or the name of a marker, or of a thing as in "box 2",
/// of `current`, the world that names mean; the pose is at `pose`. A marker is carried to `{ x =, y =, z =, heading =
/// }` [m, rad], a thing to `{ x =, y =, heading = }`, and what is left out stays as it is. The error names the nearest
/// robot, marker or field. Raises no Lua error.
struct TeleportOf {
    RunningSystem* live;
    Act act;
};
Expected<TeleportOf> read_teleport(const Objects& objects, RunningSystem& current, lua_State* L, int thing, int pose);

}  // namespace nezumi
