// Makes nested tables read-only, and writes the message about an assignment: its target, and what to do instead.
#include "bindings/lua/live/locked_copies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/lua/live/hosts_object.hpp"
#include "bindings/lua/live/object_core.hpp"
#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/sandbox/text.hpp"
#include "engine/base/error.hpp"
#include "engine/ports/setting.hpp"
#include "engine/system/act_fields.hpp"
#include "engine/tree/member.hpp"

namespace nezumi {
namespace {

// The part of a path for the key at `index`: ".position", "[2]".
std::string step_of(lua_State* L, int index) {
    switch (lua_type(L, index)) {
        case LUA_TSTRING: return fmt::format(".{}", shown(text_at(L, index)));
        case LUA_TNIL: return "";  // the whole object
        case LUA_TBOOLEAN: return lua_toboolean(L, index) != 0 ? "[true]" : "[false]";
        case LUA_TNUMBER:
            if (lua_isinteger(L, index) != 0) return fmt::format("[{}]", lua_tointeger(L, index));
            return fmt::format("[{}]", number_at(L, index));
        default: return fmt::format("[{}]", luaL_typename(L, index));
    }
}

// "controller.config", "controller.out", "hosts.ev3.vehicle".
std::string path_of(const ObjectRef& ref) {
    std::string path(ref.component());
    switch (ref.kind) {
        case ObjectKind::remote:
            path = fmt::format("hosts.{}.{}", host_of(ref.component()), without_host(ref.component()));
            return join_path(std::move(path), ref.port());
        case ObjectKind::port: return fmt::format("{}.{}", path, ref.port());
        case ObjectKind::config: return path + ".config";
        case ObjectKind::truth: return path + ".truth";
        default: return path;
    }
}

// The advice what to do instead of writing to a member of an object.
std::string instead_of(const ObjectRef& ref, std::string_view name) {
    const std::string path = path_of(ref);
    switch (ref.kind) {
        case ObjectKind::port:
            if (name == "peers") return "use connect and disconnect";
            return fmt::format("use {0}:write(value), or {0}:hold(value) to hold a value", path);
        case ObjectKind::truth:
            if (name == "pose") return fmt::format("write {}:teleport {}", ref.component(), usage_of<RobotPlace>());
            return fmt::format("write {}:disturb {}", ref.component(),
                               usage_of<VelocityConstraint>(Describe<VelocityConstraint>::at_once));
        case ObjectKind::config: return fmt::format("write the whole value: {}.{} = {{ ... }}", path, name);
        case ObjectKind::remote:
            if (ref.port() == "config") return fmt::format("write the whole value: {}.{} = {{ ... }}", path, name);
            if (!ref.port().empty()) return "";
            break;
        default: break;
    }
    const MemberInfo* member = find_member(component_members(), name);
    return member != nullptr ? std::string(member->instead) : "";
}

// The origin of the copy at index 1.
struct Origin {
    const ObjectRef* object = nullptr;
    std::string name;  // the name of the member
    std::string path;  // "controller.out.value[2]"
};

std::optional<Origin> origin_of(lua_State* L) {
    constexpr std::size_t longest = 200;
    Origin origin;
    const int top = lua_gettop(L);
    lua_pushvalue(L, 1);
    while (push_origin(L, -1)) {
        if (lua_type(L, -1) == LUA_TSTRING) origin.name = text_at(L, -1);
        if (origin.path.size() < longest) origin.path.insert(0, step_of(L, -1));
        lua_pop(L, 1);
        lua_remove(L, -2);
    }
    origin.object = to_object(L, -1);
    lua_settop(L, top);
    if (origin.object == nullptr) return std::nullopt;
    origin.path = (origin.path.size() < longest ? path_of(*origin.object) : "...") + origin.path;
    return origin;
}

// The message about an assignment to the copy at index 1, with its key at index 2. Raises no error.
std::string refusal(lua_State* L) {
    if (lua_checkstack(L, 8) == 0) return "stack overflow";
    const auto origin = origin_of(L);
    if (!origin) return "a copy can't be set";
    const std::string instead = instead_of(*origin->object, origin->name);
    return fmt::format("can't set '{0}{1}': '{0}' is a copy{2}{3}", origin->path, step_of(L, 2),
                       instead.empty() ? "" : ": ", instead);
}

int refuse(lua_State* L) {
    keep_error(L, refusal(L));
    return raise_kept(L);
}

// The error about a field that the copy at index 1 does not have. Messages and the truth have all their fields. Nothing
// for copies that may have other fields, such as a state. Raises no error.
std::string unknown_field(lua_State* L) {
    if (lua_checkstack(L, 8) == 0) return "";
    const auto origin = origin_of(L);
    if (!origin) return "";
    const ObjectKind kind = origin->object->kind;
    if (kind != ObjectKind::truth && !(kind == ObjectKind::port && origin->name == "value")) return "";
    std::vector<std::string_view> names;
    for (lua_pushnil(L); lua_next(L, 3) != 0; lua_pop(L, 1)) {
        if (lua_type(L, -2) == LUA_TSTRING) names.push_back(text_at(L, -2));
    }
    if (names.empty()) return "";
    std::sort(names.begin(), names.end());
    const std::string_view name = text_at(L, 2);
    std::string hint = did_you_mean(name, names);
    if (hint.empty()) hint = fmt::format(" (its fields are {})", fmt::join(names, ", "));
    return fmt::format("'{}' has no field '{}'{}", origin->path, shown(name), hint);
}

bool keep_unknown_field(lua_State* L) {
    std::string text = unknown_field(L);
    if (text.empty()) return false;
    keep_error(L, std::move(text));
    return true;
}

int missing(lua_State* L) { return keep_unknown_field(L) ? raise_kept(L) : 1; }

// Replaces the table on top of the stack, and all tables in it, by read-only ones.
void lock_tree(lua_State* L, int owner, int key) {
    luaL_checkstack(L, 8, nullptr);
    const int table = lua_gettop(L);
    const int locked = table + 1, inner_key = table + 2;
    lua_pushvalue(L, table);
    lock_copy(L, owner, key);
    lua_pushnil(L);
    while (lua_next(L, table) != 0) {
        if (lua_type(L, -1) == LUA_TTABLE) {
            lock_tree(L, locked, inner_key);
            lua_pushvalue(L, inner_key);
            lua_insert(L, -2);
            lua_rawset(L, table);
        } else {
            lua_pop(L, 1);
        }
    }
    lua_replace(L, table);
}

// Locks a table whose inner tables may be shared or contain themselves. Works breadth first, because a user decides the
// depth.
void lock_deeply(lua_State* L) {
    luaL_checkstack(L, 10, nullptr);
    const int root = lua_gettop(L);
    lua_newtable(L);  // the tables that are still to be done, in order
    const int tables = root + 1;
    lua_newtable(L);  // maps each table to its read-only copy
    const int locked = root + 2;
    const auto add = [&](lua_Integer place, int owner, int key) {  // the table on top of the stack
        lua_pushvalue(L, -1);
        lua_rawseti(L, tables, place);
        lua_pushvalue(L, -1);
        lua_pushvalue(L, -1);
        lock_copy(L, owner, key);
        lua_rawset(L, locked);
    };
    lua_pushvalue(L, root);
    lua_Integer count = 1;
    add(count, 1, 2);
    lua_pop(L, 1);
    for (lua_Integer at = 1; at <= count; ++at) {
        lua_rawgeti(L, tables, at);
        const int table = lua_gettop(L);
        lua_pushvalue(L, table);
        lua_rawget(L, locked);
        for (lua_pushnil(L); lua_next(L, table) != 0; lua_pop(L, 1)) {
            if (lua_type(L, -1) != LUA_TTABLE) continue;
            lua_pushvalue(L, -1);
            if (lua_rawget(L, locked) == LUA_TNIL) {
                lua_pop(L, 1);
                add(++count, table + 1, table + 2);
                lua_pushvalue(L, -1);
                lua_rawget(L, locked);
            }
            lua_pushvalue(L, -3);  // the key
            lua_insert(L, -2);
            lua_rawset(L, table);
        }
        lua_settop(L, table - 1);
    }
    lua_pushvalue(L, root);
    lua_rawget(L, locked);
    lua_replace(L, root);
    lua_settop(L, root);
}

}  // namespace

void open_locked_copies(lua_State* L) { open_copies(L, refuse, missing); }

void lock_copies(lua_State* L, Within within) {
    switch (within) {
        case Within::nothing: return lock_copy(L, 1, 2);
        case Within::tree: return lock_tree(L, 1, 2);
        case Within::anything: return lock_deeply(L);
    }
}

}  // namespace nezumi
