// Reads poses and velocities from Lua tables.
#include "bindings/lua/live/robot_acts.hpp"

#include <fmt/format.h>

#include "bindings/lua/files/read_options.hpp"
#include "bindings/lua/values/bridge.hpp"
#include "bindings/lua/values/codec.hpp"
#include "engine/base/list.hpp"
#include "engine/ports/setting.hpp"

namespace nezumi {
namespace {

// The fields of the table at `index`; messages about them begin with `what`.
template <Recorded T>
Expected<T> read_fields(lua_State* L, int index, const char* what, Reading reading = {}) {
    T out;
    if (auto ok = read_options(L, index, FieldCheck(what, "", {}, nullptr), out, reading); !ok)
        return Unexpected(ok.error());
    return out;
}

// Moves an existing marker.
Expected<Act> read_move(const System& system, const std::string& marker, lua_State* L, int index) {
    Pose3D pose;
    for (const MarkerPose& known : system.world()->markers()) {
        if (known.name == marker) pose = known.pose;
    }
    if (lua_type(L, index) != LUA_TTABLE)
        return failure(
            fmt::format("pose: expected a table {{ x =, y =, z =, heading = }}, got {}", Arguments{L}.kind(index)));
    const auto place = read_fields<MarkerPlace>(L, index, "pose");
    if (!place) return Unexpected(place.error());
    pose.position = {place->x.value_or(pose.position.x), place->y.value_or(pose.position.y),
                     place->z.value_or(pose.position.z)};
    pose.orientation.y = place->heading.value_or(pose.orientation.y);
    return MoveMarker{marker, pose};
}

// Moves an existing object.
Expected<Act> read_move_thing(const System& system, const std::string& thing, lua_State* L, int index) {
    Pose2D pose;
    for (const ThingPose& known : system.world()->things()) {
        if (known.name != thing) continue;
        pose = {{known.pose.position.x, known.pose.position.y}, known.pose.orientation.y};
    }
    if (lua_type(L, index) != LUA_TTABLE)
        return failure(
            fmt::format("pose: expected a table {{ x =, y =, heading = }}, got {}", Arguments{L}.kind(index)));
    const auto place = read_fields<MarkerPlace>(L, index, "pose");
    if (!place) return Unexpected(place.error());
    if (place->z) return failure("pose: a thing keeps its height: leave out z");
    pose.position = {place->x.value_or(pose.position.x), place->y.value_or(pose.position.y)};
    pose.heading = place->heading.value_or(pose.heading);
    return MoveThing{thing, pose};
}

}  // namespace

Expected<Pose2D> read_pose(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TTABLE)
        return failure(
            fmt::format("pose: expected a table {{ x =, y =, heading = }}, got {}", Arguments{L}.kind(index)));
    const int top = lua_gettop(L);
    const int table = lua_checkstack(L, 8) != 0 && push_behind_lock(L, index) ? lua_gettop(L) : lua_absindex(L, index);
    if (detail::push_raw_field(L, table, "position")) {
        Pose2D pose;
        Mismatch why;
        const bool fits = read_value(L, table, pose, &why);
        lua_settop(L, top);
        if (fits) return pose;
        return failure("pose: " + describe(why));
    }
    lua_settop(L, top);
    const auto place = read_fields<RobotPlace>(L, index, "pose");
    if (!place) return Unexpected(place.error());
    return Pose2D{{place->x, place->y}, place->heading};
}

Expected<VelocityConstraint> read_velocity_constraint(lua_State* L, int index, unsigned kind) {
    if (lua_type(L, index) != LUA_TTABLE) return failure("expected a table " + usage_of<VelocityConstraint>(kind));
    return read_fields<VelocityConstraint>(L, index, "disturb", {.kind = kind});
}

std::vector<std::string> marker_names(const System& system) {
    std::vector<std::string> names;
    if (system.world() == nullptr) return names;
    for (MarkerPose& marker : system.world()->markers()) names.push_back(std::move(marker.name));
    return names;
}

std::vector<std::string> thing_names(const System& system) {
    std::vector<std::string> names;
    if (system.world() == nullptr) return names;
    for (ThingPose& thing : system.world()->things()) {
        if (thing.name != "wall") names.push_back(std::move(thing.name));
    }
    return names;
}

Expected<TeleportOf> read_teleport(const Objects& objects, RunningSystem& current, lua_State* L, int thing, int pose) {
    const auto robot = objects.to_component(L, thing);
    if (robot) {
        const auto place = read_pose(L, pose);
        if (!place) return Unexpected(place.error());
        return TeleportOf{robot->live, Teleport{robot->component->name(), *place}};
    }
    // The name is not that of a robot: it may be an object, a marker, or nearly the name of a marker.
    const std::string name(lua_type(L, thing) == LUA_TSTRING ? lua_tostring(L, thing) : "");
    const std::vector<std::string> things = thing_names(current.system());
    if (contains(things, name)) {
        auto move = read_move_thing(current.system(), name, L, pose);
        if (!move) return Unexpected(move.error());
        return TeleportOf{&current, std::move(*move)};
    }
    const std::vector<std::string> markers = marker_names(current.system());
    const std::vector<std::string_view> names(markers.begin(), markers.end());
    if (contains(names, name)) {
        auto move = read_move(current.system(), name, L, pose);
        if (!move) return Unexpected(move.error());
        return TeleportOf{&current, std::move(*move)};
    }
    if (name.empty() || nearest(name, names).empty()) return Unexpected(robot.error());
    return failure(fmt::format("there is no marker '{}'{}", shown(name), did_you_mean(name, names)));
}

}  // namespace nezumi
