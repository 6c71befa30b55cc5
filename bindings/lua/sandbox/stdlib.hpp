// The part of Lua's standard library that a script gets, made safe and deterministic.
#pragma once

#include <lua.hpp>
#include <memory>
#include <string_view>
#include <vector>

#include "bindings/lua/sandbox/state.hpp"
#include "bindings/lua/syntax/globals.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// When the libraries that are tables, as `math`, come into a state. Who can look at its globals only by their names
/// can't tell, and what is never named costs no memory.
enum class Libraries {
    at_once,
    when_named,  ///< the globals' `__index` calls `open_library`
};

/// Opens the sandbox's library in a fresh state: the basic functions and `math`, `string`, `table`, `utf8`, `coroutine`
/// as read-only tables, all as globals. There is no os, io, debug, load, dofile, require, collectgarbage or _G, and
/// nothing shows an address, a clock or the order of a hash. The layer above adds its own words to the table of globals
/// (lua_pushglobaltable) and then calls `make_globals_strict`.
Expected<void> open_sandbox(LuaState& state, Libraries libraries = Libraries::at_once);

/// Opens the library of this name, if there is one, as a global. May raise a Lua error (memory).
bool open_library(lua_State* lua, std::string_view name);

/// A state with the sandbox's library.
Expected<std::unique_ptr<LuaState>> create_sandbox(StateOptions options = {}, Libraries libraries = Libraries::at_once);

/// The names that `open_sandbox` defines, sorted: what a script may read and not assign.
const std::vector<std::string_view>& sandbox_names();
/// The same with the fields of its libraries, and what there is instead of names that it does not have.
const KnownGlobals& sandbox_globals();

}  // namespace nezumi
