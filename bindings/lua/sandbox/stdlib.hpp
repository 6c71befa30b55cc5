// The part of Lua's standard library that a script gets, made safe and deterministic.
#pragma once

#include <lua.hpp>
#include <memory>
#include <string_view>
#include <vector>

#include "bindings/lua/sandbox/state.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// Opens the sandbox's library in a fresh state: the basic functions and `math`, `string`, `table`, `utf8`, `coroutine`
/// as read-only tables, all as globals. There is no os, io, debug, load, dofile, require, collectgarbage or _G, and
/// nothing shows an address, a clock or the order of a hash. The layer above adds its own words to the table of globals
/// (lua_pushglobaltable) and then calls `make_globals_strict`.
Expected<void> open_sandbox(LuaState& state);

/// A state with the sandbox's library.
Expected<std::unique_ptr<LuaState>> create_sandbox(StateOptions options = {});

/// The names that `open_sandbox` defines, sorted: what a script may read and not assign.
const std::vector<std::string_view>& sandbox_names();

}  // namespace nezumi
