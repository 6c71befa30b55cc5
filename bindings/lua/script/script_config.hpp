// The object `config` of scripts: it shows the values of the parameters, and sets them for the next tick.
#pragma once

#include <lua.hpp>

#include "bindings/lua/script/script.hpp"

namespace nezumi {

// These functions may raise a Lua error (memory).

/// Pushes the object `config` without values.
void push_config(lua_State* L, Script& script);
/// Pushes the table with the values of `config`. Raises no error.
void push_config_values(lua_State* L);
/// Updates one value of `config`.
void show_parameter(lua_State* L, const Parameters::Parameter& parameter);
/// Updates all values of `config`.
void show_parameters(lua_State* L, const Parameters& parameters);

}  // namespace nezumi
