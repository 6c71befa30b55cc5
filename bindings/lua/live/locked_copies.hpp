// Read-only copies of tables. Objects return these, because writing to a copy would have no effect.
#pragma once

#include <lua.hpp>

namespace nezumi {

/// Prepares a Lua state for read-only copies; call it once. The message about an assignment is made from names when it
/// is needed, so reading is fast. May raise a Lua error, like the other function.
void open_locked_copies(lua_State* L);

/// The structure of tables within a table: none, a flat tree, or anything that a user's script can make.
enum class Within : unsigned char { nothing, tree, anything };

/// Makes the table on top of the stack, and all tables in it, read-only. This table is the value that the object at
/// index 1 has for the key at index 2.
void lock_copies(lua_State* L, Within within);

}  // namespace nezumi
