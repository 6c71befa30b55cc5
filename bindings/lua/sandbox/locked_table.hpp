// Tables that a script can read but not change, and metatables that it can't see.
#pragma once

#include <lua.hpp>

namespace nezumi {

/// Replaces the table on top of the stack by a locked table: an empty table that reads from the original, the table
/// behind it. An assignment to the locked table is an error with `name` and `why`. `getmetatable` returns false,
/// `rawset` and `setmetatable` refuse the locked table, and `pairs`, `next`, `rawget` and `#` see the table behind it.
/// Reading a field takes one step more than in a normal table. May raise a Lua error (memory).
void lock_table(lua_State* lua, const char* name, const char* why = "is read-only");

/// Prepares `lock_copy`, for copies that objects of the engine return often: locking one takes a third of the time of
/// `lock_table`, but reading a field takes a function call. All copies of a state share one metatable. `refuse` is
/// called for every assignment (table, key, value) and raises the error. `missing` is called for every read of a
/// missing name (table, key, the table behind, nil); it raises an error or returns the nil. Call this once for each
/// state.
void open_copies(lua_State* lua, lua_CFunction refuse, lua_CFunction missing);
/// Makes the table on top of the stack a read-only copy of the value that `owner` has for `key`, both at absolute
/// indices.
void lock_copy(lua_State* lua, int owner, int key);
/// Pushes owner and key of the copy at `index`; returns false for other values.
bool push_origin(lua_State* lua, int index);

/// Whether the value at `index` is a read-only table of either kind; if so, pushes the table behind it. Raises no error
/// and runs no Lua.
bool push_behind_lock(lua_State* lua, int index);

/// Hides the metatable on top of the stack; else a script could change it for all tables that have it.
/// `getmetatable` returns nil, `setmetatable` replaces it, `ipairs` ignores its `__index`, and its tables count as
/// plain data. May raise a Lua error (memory).
void hide_metatable(lua_State* lua);

/// Whether the value at `index` has a hidden metatable. Raises no error, and leaves the stack unchanged.
bool has_hidden_metatable(lua_State* lua, int index);

}  // namespace nezumi
