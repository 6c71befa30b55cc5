// Tables that a script can read and not change.
#pragma once

#include <lua.hpp>

namespace nezumi {

/// Replaces the table on top of the stack by an empty one that reads from it; every assignment to it is an error that
/// says of `name` why it can't be. `getmetatable` gives false, `rawset` and `setmetatable` refuse it, `pairs`, `next`,
/// `rawget` and `#` see what is behind it. Reading a field costs one hop more than in an open table. May raise a Lua
/// error (memory).
void lock_table(lua_State* lua, const char* name, const char* why = "is read-only");

/// The same for the copies that objects of the engine give, often: a third of the work to make one, a call for each
/// field that is read. All of a state share one metatable, in which `refuse` is told of every assignment (table, key,
/// value); it raises the error. `missing` is told of every look at a name that is not there (table, key, what is behind
/// it, nil); it raises an error or returns the nil. Called once for a state.
void open_copies(lua_State* lua, lua_CFunction refuse, lua_CFunction missing);
/// Locks the table on top of the stack as a copy of what `owner` has under `key`, both at absolute indices.
void lock_copy(lua_State* lua, int owner, int key);
/// Pushes owner and key of the copy at `index`, or returns false when it is none.
bool push_origin(lua_State* lua, int index);

/// Whether the value at `index` is a table that is locked in either way. Then the table behind it is pushed. Raises no
/// error and runs nothing.
bool push_behind_lock(lua_State* lua, int index);

}  // namespace nezumi
