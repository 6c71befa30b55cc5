// Modules that are C++: what `require "native.NAME"` gives. Each is wrapped, and documented, by a module in Lua.
#pragma once

#include <lua.hpp>

namespace nezumi {

/// Whether the string at `index` names a native module: "native.matrix". Then it is pushed, always the same one of a
/// state. May raise a Lua error (memory).
bool push_native_module(lua_State* L, int index);

}  // namespace nezumi
