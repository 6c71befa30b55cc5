// The object `config` has no fields: reading a field reads from a table that scripts can't reach.
#include "bindings/lua/script/script_config.hpp"

#include <fmt/format.h>

#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/sandbox/ordered.hpp"
#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/script/script_call.hpp"
#include "bindings/lua/values/codec.hpp"

namespace nezumi {
namespace {

constexpr char config_values_key = 0;  // its address is a key of the registry

// Pushes a value as `config` shows it: arrays are read-only.
void push_config_value(lua_State* L, const Parameters::Parameter& parameter) {
    push_payload(L, parameter.value);
    if (lua_type(L, -1) != LUA_TTABLE) return;
    lua_pushfstring(L, "config.%s", parameter.spec.name.c_str());
    lua_insert(L, -2);
    lock_table(L, lua_tostring(L, -2));
    lua_remove(L, -2);
}

int unknown_parameter(lua_State* L) {
    Script& script = script_of(L);
    push_text(L, 2);
    return bridge(
        L, [&]() -> Expected<void> { return Unexpected(script.parameters().index_of(string_at(L, -1)).error()); });
}

int config_newindex(lua_State* L) {
    Script& script = script_of(L);
    push_text(L, 2);
    return bridge(L, [&]() -> Expected<void> {
        const std::string_view name = string_at(L, -1);
        if (script.phase() == Script::Phase::loading) {
            return failure(fmt::format("config.{} can't be set while the file loads", shown(name)));
        }
        auto value = read_parameter(L, 3);
        if (!value) return failure(fmt::format("parameter '{}': {}", shown(name), value.error().message));
        return script.parameters().stage(name, *value);
    });
}

int config_pairs(lua_State* L) {
    lua_settop(L, 0);
    lua_pushcfunction(L, ordered_pairs);
    lua_rawgetp(L, LUA_REGISTRYINDEX, &config_values_key);
    lock_table(L, "config");
    lua_call(L, 1, 3);
    return 3;
}

}  // namespace

void push_config_values(lua_State* L) { lua_rawgetp(L, LUA_REGISTRYINDEX, &config_values_key); }

void push_config(lua_State* L, Script& script) {
    lua_newuserdatauv(L, 0, 0);
    lua_createtable(L, 0, 5);
    lua_newtable(L);  // the values
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &config_values_key);
    lua_createtable(L, 0, 1);
    set_function(L, script, "__index", unknown_parameter);
    lua_setmetatable(L, -2);
    lua_setfield(L, -2, "__index");
    set_function(L, script, "__newindex", config_newindex);
    lua_pushcfunction(L, config_pairs);
    lua_setfield(L, -2, "__pairs");
    lua_pushliteral(L, "config");
    lua_setfield(L, -2, "__name");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
}

void show_parameter(lua_State* L, const Parameters::Parameter& parameter) {
    luaL_checkstack(L, 10, nullptr);
    lua_rawgetp(L, LUA_REGISTRYINDEX, &config_values_key);
    lua_pushlstring(L, parameter.spec.name.data(), parameter.spec.name.size());
    push_config_value(L, parameter);
    lua_rawset(L, -3);
    lua_pop(L, 1);
}

void show_parameters(lua_State* L, const Parameters& parameters) {
    for (const auto& parameter : parameters.all()) show_parameter(L, parameter);
}

}  // namespace nezumi
