// The tables that objects give: copies that can't be written, as nothing would come of it.
#pragma once

#include <lua.hpp>

namespace nezumi {

/// What an assignment to a copy says is made from names alone, so that a look costs nothing for it. Once for a state.
/// May raise a Lua error, as the other.
void open_locked_copies(lua_State* L);

/// What the tables in a table are: each is one's own and they lie few deep, or a user has made them.
enum class Within : unsigned char { nothing, tree, anything };

/// Locks the table on top of the stack and all tables in it: what the object at index 1 has under the key at index 2.
void lock_copies(lua_State* L, Within within);

}  // namespace nezumi
