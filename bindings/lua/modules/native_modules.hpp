// Modules in C++, for `require "native.NAME"`. A module in Lua wraps and documents each.
#pragma once

#include <lua.hpp>

namespace nezumi {

/// Whether the string at `index` names a native module: "native.matrix". If so, pushes the module, the same one each
/// time. May raise a Lua error (memory).
bool push_native_module(lua_State* L, int index);

}  // namespace nezumi
