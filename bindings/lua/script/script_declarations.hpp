// The globals that declare ports, parameters and commands: input, output, param, command, about.
#pragma once

#include <lua.hpp>

#include "bindings/lua/script/script.hpp"

namespace nezumi {

/// Sets these globals in the table on top of the stack. May raise a Lua error (memory).
void set_declaring_globals(lua_State* L, Script& script);

}  // namespace nezumi
