// Plain data put into a table that a script has already.
#pragma once

#include <lua.hpp>

#include "engine/values/plain_data.hpp"

namespace nezumi {

/// Makes the table on top of the stack, which stays, hold the table that is the first of `data.values`. Tables within
/// it stay the same ones where both have one under a key, for the locals that know them; what is no plain data stays as
/// it is. May raise a Lua error (memory): use it within a protected call.
void set_plain(lua_State* L, const PlainData& data);

}  // namespace nezumi
