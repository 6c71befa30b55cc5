// `pairs` and `next` in a fixed order of keys: 1..n, other numbers, strings, false, true.
//
// Lua's own order depends on a hash that is seeded by address and time, so it differs from run to run. This traversal
// visits 1..n, then a sorted list of the other keys. As in Lua, fields may be assigned and cleared meanwhile; a key
// that is added meanwhile may or may not be visited.
#pragma once

#include <lua.hpp>

namespace nezumi {

/// The function `pairs`. Supports `__pairs`.
int ordered_pairs(lua_State* lua);

/// The function `next`. Fast for an empty table. For a table with n keys that are not a sequence, the first call takes
/// time in proportion to n.
int ordered_next(lua_State* lua);

}  // namespace nezumi
