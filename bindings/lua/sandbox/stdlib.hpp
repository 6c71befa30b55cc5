// The part of Lua's standard library for scripts, made safe and deterministic.
#pragma once

#include <lua.hpp>
#include <memory>
#include <string_view>
#include <vector>

#include "bindings/lua/sandbox/state.hpp"
#include "bindings/lua/syntax/globals.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// When libraries that are tables, such as `math`, are added to a state. Code that reads globals only by name sees no
/// difference, and unused libraries take no memory.
enum class Libraries {
    at_once,
    when_named,  ///< the `__index` of the globals calls `open_library`
};

/// Opens the sandbox's library in a new state: the basic functions, and `math`, `string`, `table`, `utf8`, `coroutine`
/// as read-only tables, all as globals. There is no os, io, debug, load, dofile, require, collectgarbage or _G, and
/// nothing shows an address, a clock or the order of a hash. The caller adds its own words to the table of globals
/// (lua_pushglobaltable) and then calls `make_globals_strict`.
Expected<void> open_sandbox(LuaState& state, Libraries libraries = Libraries::at_once);

/// Opens the library with this name, if there is one, as a global. May raise a Lua error (memory).
bool open_library(lua_State* lua, std::string_view name);

/// A state with the sandbox's library.
Expected<std::unique_ptr<LuaState>> create_sandbox(StateOptions options = {}, Libraries libraries = Libraries::at_once);

/// The names that `open_sandbox` defines, sorted. A script may read but not assign them.
const std::vector<std::string_view>& sandbox_names();
/// The names of the sandbox with the fields of the libraries, and with replacements for missing names.
const KnownGlobals& sandbox_globals();

}  // namespace nezumi
