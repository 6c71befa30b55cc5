// The globals of scripts beside Lua's library: input, output, param, config, state, now, log, about, command, probe,
// require.
#pragma once

#include <lua.hpp>
#include <string_view>
#include <vector>

#include "bindings/lua/script/script.hpp"

namespace nezumi {

/// Adds the globals of a script to its Lua state, without `state`. Until `state` is set, a script that reads it gets an
/// empty table and is marked (`Script::note_look_at_tick`). May raise a Lua error (memory).
void install_globals(lua_State* L, Script& script);

/// Sets `state` to a copy of this data, or to an empty table. May raise a Lua error (memory).
void set_state_global(lua_State* L, const PlainData* state);

/// The names of all globals of scripts, without those of Lua's library.
const std::vector<std::string_view>& script_globals();

/// Pushes the table `state`. Raises no error.
void push_state(lua_State* L);

}  // namespace nezumi
