// Userdata that refer by name, their metatables, and the way of answers into Lua.
#include "bindings/lua/live/objects.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cstring>
#include <new>

#include "bindings/lua/live/object_core.hpp"
#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/values/codec.hpp"

namespace nezumi {
namespace {

// Their addresses are the keys of the metatables in the registry.
constexpr char metatable_keys[object_kinds] = {};

const ObjectFunctions& functions_of(std::size_t kind) {
    switch (static_cast<ObjectKind>(kind)) {
        case ObjectKind::system: return system_functions();
        case ObjectKind::component: return component_functions();
        case ObjectKind::ports: return ports_functions();
        case ObjectKind::port: return port_functions();
        case ObjectKind::config: return config_functions();
        case ObjectKind::hosts: return hosts_functions();
        case ObjectKind::host: return host_functions();
        case ObjectKind::remote: return remote_functions();
        case ObjectKind::remote_config: return remote_config_functions();
        case ObjectKind::truth: break;
    }
    return truth_functions();
}

// Two objects are equal when they mean the same thing.
int objects_equal(lua_State* L) {
    const ObjectRef* a = to_object(L, 1);
    const ObjectRef* b = to_object(L, 2);
    const bool same = a != nullptr && b != nullptr && a->kind == b->kind && a->live() == b->live() &&
                      a->component() == b->component() && a->port() == b->port();
    lua_pushboolean(L, same ? 1 : 0);
    return 1;
}

void set_function(lua_State* L, Objects& objects, const char* name, lua_CFunction function) {
    if (function == nullptr) return;
    lua_pushlightuserdata(L, &objects);
    lua_pushcclosure(L, function, 1);
    lua_setfield(L, -2, name);
}

void make_metatable(lua_State* L, Objects& objects, std::size_t kind) {
    const ObjectFunctions& functions = functions_of(kind);
    lua_createtable(L, 0, 7);
    set_function(L, objects, "__index", functions.index);
    set_function(L, objects, "__newindex", functions.newindex);
    set_function(L, objects, "__pairs", functions.pairs);
    set_function(L, objects, "__tostring", functions.tostring);
    lua_pushcfunction(L, objects_equal);
    lua_setfield(L, -2, "__eq");
    lua_pushstring(L, functions.name);
    lua_setfield(L, -2, "__name");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_rawsetp(L, LUA_REGISTRYINDEX, &metatable_keys[kind]);
}

// Replaces the table on top of the stack, and all tables in it, by locked ones. Breadth first: their depth is a user's.
void lock_deeply(lua_State* L, const char* name) {
    luaL_checkstack(L, 10, nullptr);
    const int root = lua_gettop(L);
    lua_newtable(L);  // the open tables, in order
    const int tables = root + 1;
    lua_newtable(L);  // from each open table to the locked one
    const int locked = root + 2;
    const auto add = [&](lua_Integer place) {  // the table on top of the stack
        lua_pushvalue(L, -1);
        lua_rawseti(L, tables, place);
        lua_pushvalue(L, -1);
        lua_pushvalue(L, -1);
        lock_table(L, name);
        lua_rawset(L, locked);
    };
    lua_pushvalue(L, root);
    lua_Integer count = 1;
    add(count);
    lua_pop(L, 1);
    for (lua_Integer at = 1; at <= count; ++at) {
        lua_rawgeti(L, tables, at);
        const int table = lua_gettop(L);
        for (lua_pushnil(L); lua_next(L, table) != 0; lua_pop(L, 1)) {
            if (lua_type(L, -1) != LUA_TTABLE) continue;
            lua_pushvalue(L, -1);
            if (lua_rawget(L, locked) == LUA_TNIL) {
                lua_pop(L, 1);
                add(++count);
                lua_pushvalue(L, -1);
                lua_rawget(L, locked);
            }
            lua_pushvalue(L, -3);  // the key
            lua_insert(L, -2);
            lua_rawset(L, table);
        }
        lua_pop(L, 1);
    }
    lua_pushvalue(L, root);
    lua_rawget(L, locked);
    lua_replace(L, root);
    lua_settop(L, root);
}

// The same for a payload's table, which is shallow and no part of itself: each table is called by its own path.
void lock_payload(lua_State* L, const char* name, const char* why) {
    luaL_checkstack(L, 10, nullptr);
    const int table = lua_gettop(L);
    for (lua_pushnil(L); lua_next(L, table) != 0; lua_pop(L, 1)) {
        if (lua_type(L, -1) != LUA_TTABLE || lua_type(L, -2) != LUA_TSTRING) continue;
        const char* inner = lua_pushfstring(L, "%s.%s", name, lua_tostring(L, -2));
        lua_insert(L, -2);
        lock_payload(L, inner, why);
        lua_remove(L, -2);
        lua_pushvalue(L, -2);
        lua_pushvalue(L, -2);
        lua_rawset(L, table);
    }
    lock_table(L, name, why);
}

void push_names(lua_State* L, const std::vector<std::string>& names) {
    lua_createtable(L, static_cast<int>(names.size()), 0);
    for (std::size_t i = 0; i < names.size(); ++i) {
        lua_pushlstring(L, names[i].data(), names[i].size());
        lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
    }
}

int push_locked(lua_State* L, const LockedValue& locked) {
    if (const auto* payload = std::get_if<AnyPayload>(&locked.value)) {
        push_payload(L, *payload);
        lock_payload(L, locked.name.c_str(), locked.why.c_str());
        return 1;
    }
    if (const auto* parameter = std::get_if<ParameterValue>(&locked.value)) {
        push_parameter(L, *parameter);
    } else if (const auto* data = std::get_if<PlainLook>(&locked.value)) {
        push_plain(L, *data);
    } else {
        lua_newtable(L);
        for (const auto& [name, number] : std::get<std::map<std::string, double>>(locked.value)) {
            lua_pushlstring(L, name.data(), name.size());
            lua_pushnumber(L, number);
            lua_rawset(L, -3);
        }
    }
    if (lua_type(L, -1) == LUA_TTABLE) lock_deeply(L, locked.name.c_str());
    return 1;
}

}  // namespace

Objects::Objects() : core_(std::make_unique<Core>()) {}
Objects::~Objects() = default;

Expected<std::unique_ptr<Objects>> Objects::open(LuaState& state, std::function<LiveSystem&()> current, Actor who) {
    std::unique_ptr<Objects> objects(new Objects);
    objects->core_->state = &state;
    objects->core_->current = std::move(current);
    objects->core_->who = std::move(who);
    const auto made = protect(state.lua(), Budget{10.0}, [&objects](lua_State* L) {
        for (std::size_t kind = 0; kind < object_kinds; ++kind) make_metatable(L, *objects, kind);
        return 0;
    });
    if (!made) return Unexpected(made.error());
    return objects;
}

void Objects::push_system(lua_State* L, LiveSystem& live) { push_object(L, *this, ObjectKind::system, live, "", ""); }

void Objects::push_component(lua_State* L, LiveSystem& live, std::string_view name) {
    push_object(L, *this, ObjectKind::component, live, name, "");
}

void Objects::push_component(lua_State* L, LiveSystem* const& place, std::string_view name) {
    push_object(L, {this, nullptr, &place, 0, 0, ObjectKind::component}, name, "");
}

void Objects::push_port(lua_State* L, LiveSystem& live, std::string_view component, std::string_view port) {
    push_object(L, *this, ObjectKind::port, live, component, port);
}

ObjectRef* to_object(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TUSERDATA || lua_checkstack(L, 3) == 0 || lua_getmetatable(L, index) == 0)
        return nullptr;
    bool ours = false;
    for (const char& key : metatable_keys) {
        lua_rawgetp(L, LUA_REGISTRYINDEX, &key);
        ours = ours || lua_rawequal(L, -1, -2) != 0;
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
    return ours ? static_cast<ObjectRef*>(lua_touserdata(L, index)) : nullptr;
}

ObjectRef* to_object(lua_State* L, int index, ObjectKind kind) {
    ObjectRef* ref = to_object(L, index);
    return ref != nullptr && ref->kind == kind ? ref : nullptr;
}

void push_object(lua_State* L, ObjectRef ref, std::string_view component, std::string_view port) {
    luaL_checkstack(L, 3, nullptr);
    void* block = lua_newuserdatauv(L, sizeof(ObjectRef) + component.size() + port.size(), 0);
    ref.component_length = static_cast<std::uint32_t>(component.size());
    ref.port_length = static_cast<std::uint32_t>(port.size());
    char* names = reinterpret_cast<char*>(new (block) ObjectRef(ref) + 1);
    if (!component.empty()) std::memcpy(names, component.data(), component.size());
    if (!port.empty()) std::memcpy(names + component.size(), port.data(), port.size());
    lua_rawgetp(L, LUA_REGISTRYINDEX, &metatable_keys[static_cast<std::size_t>(ref.kind)]);
    lua_setmetatable(L, -2);
}

void push_object(lua_State* L, Objects& objects, ObjectKind kind, LiveSystem& live, std::string_view component,
                 std::string_view port) {
    push_object(L, {&objects, &live, nullptr, 0, 0, kind}, component, port);
}

void push_method(lua_State* L, Objects& objects, lua_CFunction function, std::string_view name) {
    luaL_checkstack(L, 3, nullptr);
    lua_pushlightuserdata(L, &objects);
    lua_pushlstring(L, name.data(), name.size());
    lua_pushcclosure(L, function, 2);
}

int push_answer(lua_State* L, Objects& objects) {
    struct Pusher {
        lua_State* lua;
        Objects& objects;

        int operator()(std::monostate) const { return 0; }
        int operator()(bool value) const { return lua_pushboolean(lua, value ? 1 : 0), 1; }
        int operator()(std::int64_t value) const { return lua_pushinteger(lua, value), 1; }
        int operator()(double value) const { return lua_pushnumber(lua, value), 1; }
        int operator()(const std::string& text) const { return lua_pushlstring(lua, text.data(), text.size()), 1; }
        int operator()(const std::vector<std::string>& names) const { return push_names(lua, names), 1; }
        int operator()(const AnyPayload& value) const { return push_payload(lua, value), 1; }
        int operator()(const ParameterValue& value) const { return push_parameter(lua, value), 1; }
        int operator()(const PlainData& data) const {
            luaL_checkstack(lua, static_cast<int>(data.values.size()) + 10, nullptr);
            push_plain(lua, data);
            return static_cast<int>(data.values.size());
        }
        int operator()(const ObjectName& name) const {
            push_object(lua, objects, name.kind, *name.live, name.component, name.port);
            return 1;
        }
        int operator()(const MethodName& method) const {
            push_method(lua, objects, method.function, method.name);
            return 1;
        }
        int operator()(const LockedValue& locked) const { return push_locked(lua, locked); }
    };
    luaL_checkstack(L, 30, nullptr);
    return std::visit(Pusher{L, objects}, ObjectAccess::core(objects).answer);
}

}  // namespace nezumi
