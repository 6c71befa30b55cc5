// The functions of `string` that take patterns.
#pragma once

#include <lua.hpp>

namespace nezumi::library {

/// `find`, `match`, `gmatch`, `gsub` as in Lua 5.4, with the step limit of the call into Lua.
int find_pattern(lua_State* lua);
int match_pattern(lua_State* lua);
int match_all(lua_State* lua);
int substitute(lua_State* lua);

}  // namespace nezumi::library
