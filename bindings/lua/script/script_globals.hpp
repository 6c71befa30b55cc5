// The globals that scripts have beside Lua's library: input, output, param, config, state, now, log, about, command,
// probe, require.
#pragma once

#include <lua.hpp>
#include <string_view>
#include <vector>

#include "bindings/lua/script/script.hpp"

namespace nezumi {

/// Puts them into a script's Lua state, with a copy of this `state` unless it is null. May raise a
/// Lua error (memory).
void install_globals(lua_State* L, Script& script, const PlainData* state);

/// Their names, without those of the library.
const std::vector<std::string_view>& script_globals();

/// Pushes the table behind `state`. May raise a Lua error (memory).
void push_state(lua_State* L);

}  // namespace nezumi
