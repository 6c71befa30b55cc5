// Metatables of the engine's own, on tables that are plain ones to a script.
#pragma once

#include <lua.hpp>

namespace nezumi {

/// Marks the metatable on top of the stack as hidden from scripts, which could change it for all tables that have it:
/// `getmetatable` gives nil, `setmetatable` replaces it, `ipairs` does not ask its `__index`, and a table that has it
/// is plain data. May raise a Lua error (memory).
void hide_metatable(lua_State* lua);

/// Whether the value at `index` has such a metatable. Raises nothing, and leaves the stack as it was.
bool has_hidden_metatable(lua_State* lua, int index);

}  // namespace nezumi
