// Metatables of the engine that scripts can't see: their tables look like plain tables.
#pragma once

#include <lua.hpp>

namespace nezumi {

/// Marks the metatable on top of the stack as hidden, because scripts could change it for all its tables:
/// `getmetatable` returns nil, `setmetatable` replaces it, `ipairs` ignores its `__index`, and its tables count as
/// plain data. May raise a Lua error (memory).
void hide_metatable(lua_State* lua);

/// Whether the value at `index` has such a metatable. Raises no error, and leaves the stack unchanged.
bool has_hidden_metatable(lua_State* lua, int index);

}  // namespace nezumi
