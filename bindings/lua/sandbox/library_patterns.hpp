// The functions of `string` that take patterns.
#pragma once

#include <lua.hpp>

namespace nezumi::library {

/// `find`, `match`, `gmatch`, `gsub` as in Lua 5.4, under the step budget of the call into Lua that they run in.
int find_pattern(lua_State* lua);
int match_pattern(lua_State* lua);
int match_all(lua_State* lua);
int substitute(lua_State* lua);

}  // namespace nezumi::library
