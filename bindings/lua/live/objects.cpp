// Userdata that refer by name, their metatables, and the conversion of answers to Lua values.
#include "bindings/lua/live/objects.hpp"

#include <algorithm>
#include <cstring>
#include <new>

#include "bindings/lua/live/locked_copies.hpp"
#include "bindings/lua/live/object_core.hpp"
#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/values/codec.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi {
namespace {

constexpr char metatable_keys[object_kinds] = {};  // their addresses are keys of the registry
constexpr int mark_index = 1;                      // only the metatables of objects have an element

ObjectFunctions functions_of(ObjectKind kind) {
    switch (kind) {
        case ObjectKind::hosts: return hosts_functions();
        case ObjectKind::host: return host_functions();
        case ObjectKind::remote: return remote_functions();
        default: return node_functions(kind);
    }
}

// Two objects are equal if they mean the same thing.
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
    const ObjectFunctions functions = functions_of(static_cast<ObjectKind>(kind));
    lua_createtable(L, mark_index, 8);
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
    lua_pushboolean(L, 1);
    lua_rawseti(L, -2, mark_index);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &metatable_keys[kind]);
}

// Whether the table of a payload contains no tables.
bool is_flat(const Type& type) {
    const auto has_table = [](const Type& each) { return !each.is_single(); };
    if (type.kind == Type::Kind::sequence) return !has_table(*type.element);
    return std::none_of(type.fields.begin(), type.fields.end(),
                        [&](const Type::Field& field) { return has_table(*field.type); });
}

}  // namespace

Objects::Objects() : core_(std::make_unique<Core>()) {}
Objects::~Objects() = default;

Expected<std::unique_ptr<Objects>> Objects::open(LuaState& state, std::function<RunningSystem&()> current, Actor who) {
    std::unique_ptr<Objects> objects(new Objects);
    objects->core_->state = &state;
    objects->core_->current = std::move(current);
    objects->core_->who = std::move(who);
    const auto made = protect(state.lua(), Budget{10.0}, [&objects](lua_State* L) {
        for (std::size_t kind = 0; kind < object_kinds; ++kind) make_metatable(L, *objects, kind);
        open_locked_copies(L);
        return 0;
    });
    if (!made) return Unexpected(made.error());
    return objects;
}

void Objects::push_system(lua_State* L, RunningSystem& live) {
    push_object(L, *this, ObjectKind::system, live, "", "");
}

void Objects::push_component(lua_State* L, RunningSystem& live, std::string_view name) {
    push_object(L, *this, ObjectKind::component, live, name, "");
}

void Objects::push_component(lua_State* L, RunningSystem* const& place, std::string_view name) {
    push_object(L, {this, nullptr, &place, 0, 0, ObjectKind::component}, name, "");
}

void Objects::push_port(lua_State* L, RunningSystem& live, std::string_view component, std::string_view port) {
    push_object(L, *this, ObjectKind::port, live, component, port);
}

ObjectRef* to_object(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TUSERDATA || lua_checkstack(L, 3) == 0 || lua_getmetatable(L, index) == 0)
        return nullptr;
    const bool ours = lua_rawgeti(L, -1, mark_index) != LUA_TNIL;
    lua_pop(L, 2);
    return ours ? static_cast<ObjectRef*>(lua_touserdata(L, index)) : nullptr;
}

ObjectRef* to_object(lua_State* L, int index, ObjectKind kind) {
    ObjectRef* ref = to_object(L, index);
    return ref != nullptr && ref->kind == kind ? ref : nullptr;
}

void push_object(lua_State* L, ObjectRef ref, std::string_view component, std::string_view port) {
    luaL_checkstack(L, 3, nullptr);
    void* block = lua_newuserdatauv(L, sizeof(ObjectRef) + component.size() + port.size(),
                                    ref.kind == ObjectKind::system ? 1 : 0);
    ref.component_length = static_cast<std::uint32_t>(component.size());
    ref.port_length = static_cast<std::uint32_t>(port.size());
    char* names = reinterpret_cast<char*>(new (block) ObjectRef(ref) + 1);
    if (!component.empty()) std::memcpy(names, component.data(), component.size());
    if (!port.empty()) std::memcpy(names + component.size(), port.data(), port.size());
    lua_rawgetp(L, LUA_REGISTRYINDEX, &metatable_keys[static_cast<std::size_t>(ref.kind)]);
    lua_setmetatable(L, -2);
}

void push_object(lua_State* L, Objects& objects, ObjectKind kind, RunningSystem& live, std::string_view component,
                 std::string_view port) {
    push_object(L, {&objects, &live, nullptr, 0, 0, kind}, component, port);
}

void push_method(lua_State* L, Objects& objects, lua_CFunction function, std::string_view name) {
    luaL_checkstack(L, 3, nullptr);
    lua_pushlightuserdata(L, &objects);
    lua_pushlstring(L, name.data(), name.size());
    lua_pushcclosure(L, function, 2);
}

int push_answer(lua_State* L, Objects& objects, Tables tables) {
    struct Pusher {
        lua_State* lua;
        Objects& objects;
        Tables tables;

        // One value is on the stack; makes its tables read-only if this is wanted.
        int one(Within within = Within::nothing) const {
            if (tables == Tables::locked && lua_type(lua, -1) == LUA_TTABLE) lock_copies(lua, within);
            return 1;
        }

        int operator()(const Value& value) const {
            if (value.is_nothing()) return 0;
            if (const auto* data = value.get_if<PlainData>()) {
                luaL_checkstack(lua, static_cast<int>(data->values.size()) + 10, nullptr);
                push_plain(lua, *data);
                return static_cast<int>(data->values.size());
            }
            push_payload(lua, value);
            return one(is_flat(value.type()) ? Within::nothing : Within::tree);
        }
        int operator()(const PlainSnapshot& snapshot) const { return push_plain(lua, snapshot), one(Within::anything); }
        int operator()(const ObjectName& name) const {
            push_object(lua, objects, name.kind, *name.live, name.component, name.port);
            return 1;
        }
        int operator()(const MethodName& method) const {
            push_method(lua, objects, method.function, method.name);
            return 1;
        }
    };
    luaL_checkstack(L, 30, nullptr);
    return std::visit(Pusher{L, objects, tables}, ObjectAccess::core(objects).answer);
}

}  // namespace nezumi
