// Puts plain data into an existing table of a script.
#pragma once

#include <lua.hpp>

#include "engine/values/plain_data.hpp"

namespace nezumi {

/// Gives the table on top of the stack, which stays there, the contents of the first value of `data`, if this is a
/// table. If both have a table under the same key, the script's table is kept and changed, because local variables may
/// refer to it. Values that are not plain data stay unchanged. May raise a Lua error (memory): use it within a
/// protected call.
void set_plain(lua_State* L, const PlainData& data);

}  // namespace nezumi
