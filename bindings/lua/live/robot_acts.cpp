// Acts on the abstract world by the robot's id.
#include "bindings/lua/live/robot_acts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/values/codec.hpp"

namespace nezumi {
namespace {

// The table at an index, or while this lives the one behind it when that one is locked.
struct Table {
    Table(lua_State* state, int at) : lua(state), top(lua_gettop(state)), index(lua_absindex(state, at)) {
        if (lua_checkstack(lua, 8) != 0 && push_behind_lock(lua, index)) index = lua_gettop(lua);
    }
    ~Table() { lua_settop(lua, top); }
    Table(const Table&) = delete;
    Table& operator=(const Table&) = delete;

    lua_State* lua;
    int top;
    int index;
};

// Refuses every key of a table that is none of these.
Expected<void> check_keys(lua_State* L, int table, const std::vector<std::string_view>& names, std::string_view what) {
    Expected<void> ok;
    lua_pushnil(L);
    while (lua_next(L, table) != 0) {
        const bool is_text = lua_type(L, -2) == LUA_TSTRING;
        const std::string_view key = is_text ? detail::key_text(L) : "";
        bool known = false;
        for (const std::string_view name : names) known = known || name == key;
        if (!known && ok) {
            ok = is_text ? Expected<void>(failure(
                               fmt::format("{}: unknown field '{}'{}", what, shown(key), did_you_mean(key, names))))
                         : Expected<void>(failure(
                               fmt::format("{}: expected fields with names, as in {{ {} = 0 }}", what, names.front())));
        }
        lua_pop(L, 1);
    }
    return ok;
}

Expected<std::optional<double>> read_field(lua_State* L, int table, std::string_view name, std::string_view what) {
    if (!detail::push_raw_field(L, table, name)) return std::optional<double>{};
    double value = 0;
    Mismatch why;
    const bool fits = read_value(L, lua_gettop(L), value, &why);
    lua_pop(L, 1);
    if (!fits) return failure(fmt::format("{}: field '{}' {}", what, name, why.text));
    return std::optional<double>(value);
}

// Carries a marker that is there.
Expected<void> move_marker(System& system, std::string_view marker, lua_State* L, int index) {
    Pose3D pose;
    for (const MarkerPose& known : system.world()->markers()) {
        if (known.name == marker) pose = known.pose;
    }
    if (lua_type(L, index) != LUA_TTABLE)
        return failure(fmt::format("pose: expected a table {{ x =, y =, z =, heading = }}, got {}",
                                   lua_type(L, index) == LUA_TNONE ? "nothing" : luaL_typename(L, index)));
    const Table table(L, index);
    if (auto ok = check_keys(L, table.index, {"x", "y", "z", "heading"}, "pose"); !ok) return ok;
    for (const auto& [name, target] : {std::pair<std::string_view, double*>{"x", &pose.position.x},
                                       {"y", &pose.position.y},
                                       {"z", &pose.position.z},
                                       {"heading", &pose.orientation.y}}) {
        const auto value = read_field(L, table.index, name, "pose");
        if (!value) return Unexpected(value.error());
        *target = value->value_or(*target);
    }
    return system.world()->move_marker(marker, pose);
}

}  // namespace

Expected<Robot*> simulated_robot(const System& system, Component& component) {
    auto* robot = dynamic_cast<Robot*>(&component);
    if (robot == nullptr) return failure(fmt::format("{} is no robot", component.name()));
    if (system.world() == nullptr) return failure("there is no simulated world");
    return robot;
}

Expected<Pose2D> read_pose(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TTABLE)
        return failure(fmt::format("pose: expected a table {{ x =, y =, heading = }}, got {}",
                                   lua_type(L, index) == LUA_TNONE ? "nothing" : luaL_typename(L, index)));
    const Table table(L, index);
    if (detail::push_raw_field(L, table.index, "position")) {
        Pose2D pose;
        Mismatch why;
        if (read_value(L, table.index, pose, &why)) return pose;
        return failure("pose: " + describe(why));
    }
    if (auto ok = check_keys(L, table.index, {"x", "y", "heading"}, "pose"); !ok) return Unexpected(ok.error());
    Pose2D pose;
    for (const auto& [name, target] : {std::pair<std::string_view, double*>{"x", &pose.position.x},
                                       {"y", &pose.position.y},
                                       {"heading", &pose.heading}}) {
        const auto value = read_field(L, table.index, name, "pose");
        if (!value) return Unexpected(value.error());
        *target = value->value_or(0);
    }
    return pose;
}

Expected<Push> read_push(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TTABLE) return failure("expected a table { vx =, va = }");
    const Table table(L, index);
    if (auto ok = check_keys(L, table.index, {"vx", "vy", "va"}, "disturb"); !ok) return Unexpected(ok.error());
    Push push;
    for (const auto& [name, target] :
         {std::pair<std::string_view, std::optional<double>*>{"vx", &push.vx}, {"vy", &push.vy}, {"va", &push.va}}) {
        const auto value = read_field(L, table.index, name, "disturb");
        if (!value) return Unexpected(value.error());
        *target = *value;
    }
    return push;
}

Expected<void> teleport(System& system, Component& component, const Pose2D& pose) {
    const auto robot = simulated_robot(system, component);
    if (!robot) return Unexpected(robot.error());
    return system.world()->teleport((*robot)->id(), pose);
}

std::vector<std::string> marker_names(const System& system) {
    std::vector<std::string> names;
    if (system.world() == nullptr) return names;
    for (MarkerPose& marker : system.world()->markers()) names.push_back(std::move(marker.name));
    return names;
}

Expected<void> teleport(const Objects& objects, System& current, lua_State* L, int thing, int pose) {
    const auto robot = objects.to_component(L, thing);
    if (robot) {
        const auto place = read_pose(L, pose);
        if (!place) return Unexpected(place.error());
        return teleport(robot->live->system(), *robot->component, *place);
    }
    // A marker, or a slip in one's name.
    const std::string name(lua_type(L, thing) == LUA_TSTRING ? lua_tostring(L, thing) : "");
    const std::vector<std::string> markers = marker_names(current);
    const std::vector<std::string_view> names(markers.begin(), markers.end());
    if (std::find(names.begin(), names.end(), name) != names.end()) return move_marker(current, name, L, pose);
    if (name.empty() || nearest(name, names).empty()) return Unexpected(robot.error());
    return failure(fmt::format("there is no marker '{}'{}", shown(name), did_you_mean(name, names)));
}

Expected<void> disturb(System& system, Component& component, const Push& push) {
    const auto robot = simulated_robot(system, component);
    if (!robot) return Unexpected(robot.error());
    system.world()->disturb((*robot)->id(), push);
    return {};
}

Expected<void> press(System& system, Component& component, std::string_view sensor, bool pressed) {
    const auto robot = simulated_robot(system, component);
    if (!robot) return Unexpected(robot.error());
    std::vector<std::string_view> names;
    const auto& sensors = (*robot)->spec().sensors;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        if (sensors[i].kind != SensorSpec::Kind::button && sensors[i].kind != SensorSpec::Kind::touch) continue;
        if (sensors[i].name == sensor) {
            system.world()->press((*robot)->id(), i, pressed);
            return {};
        }
        names.emplace_back(sensors[i].name);
    }
    if (names.empty()) return failure(fmt::format("{} has no buttons", component.name()));
    const std::string near = did_you_mean(sensor, names);
    return failure(fmt::format("{} has no button '{}'{}", component.name(), shown(sensor),
                               near.empty() ? fmt::format(" (it has {})", fmt::join(names, ", ")) : near));
}

}  // namespace nezumi
