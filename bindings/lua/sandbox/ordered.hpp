// `pairs` and `next` in an order that depends on the keys alone: 1..n, other numbers, strings, false, true.
//
// Lua's own order follows a hash that is seeded by address and time, so it changes from run to run. A traversal visits
// 1..n as long as there is a value, then takes a sorted list of the keys that are left. Fields may be assigned and
// cleared on the way as in Lua; a key that is added on the way may or may not be visited.
#pragma once

#include <lua.hpp>

namespace nezumi {

/// The function `pairs`. Honours `__pairs`.
int ordered_pairs(lua_State* lua);

/// The function `next`. To find a table empty costs nothing; to get the first of n keys that are no sequence costs n.
int ordered_next(lua_State* lua);

}  // namespace nezumi
