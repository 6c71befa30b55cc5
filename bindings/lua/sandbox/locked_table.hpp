// Tables that a script can read and not change.
#pragma once

#include <lua.hpp>

namespace nezumi {

/// Replaces the table on top of the stack by an empty one that reads from it; every assignment to it is an error that
/// says of `name` why it can't be. `getmetatable` gives false, `rawset` and `setmetatable` refuse it, `pairs`, `next`,
/// `rawget` and `#` see what is behind it. Reading a field costs one hop more than in an open table. May raise a Lua
/// error (memory).
void lock_table(lua_State* lua, const char* name, const char* why = "is read-only");

/// Whether the value at `index` is such a table. Then the table behind it is pushed. Raises no error and runs nothing.
bool push_behind_lock(lua_State* lua, int index);

}  // namespace nezumi
