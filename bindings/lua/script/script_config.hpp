// `config` as scripts see it: it shows the values of the parameters, and sets them for the next tick.
#pragma once

#include <lua.hpp>

#include "bindings/lua/script/script.hpp"

namespace nezumi {

// All of these may raise a Lua error (memory).

/// Pushes the object `config`, which shows nothing yet.
void push_config(lua_State* L, Script& script);
/// Pushes the table with the values that it shows. Raises nothing.
void push_config_values(lua_State* L);
/// Lets it show this value.
void show_parameter(lua_State* L, const Parameters::Parameter& parameter);
/// Lets it show all values.
void show_parameters(lua_State* L, const Parameters& parameters);

}  // namespace nezumi
