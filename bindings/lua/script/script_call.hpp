// Finds the script of a C function that scripts call, and handles errors of declarations.
#pragma once

#include <lua.hpp>

#include "bindings/lua/script/script.hpp"
#include "bindings/lua/values/bridge.hpp"

namespace nezumi {

/// The script of the running C function, which `set_function` stored.
inline Script& script_of(lua_State* L) { return *static_cast<Script*>(lua_touserdata(L, lua_upvalueindex(1))); }

/// Sets a field of the table on top of the stack to a C function with its script. May raise a Lua error (memory).
inline void set_function(lua_State* L, Script& script, const char* name, lua_CFunction function) {
    lua_pushlightuserdata(L, &script);
    lua_pushcclosure(L, function, 1);
    lua_setfield(L, -2, name);
}

/// The line of the script that called the running C function; no location if there is none.
Place caller(lua_State* L);

/// A registry reference to the function at index 2, for a global with at most 3 arguments; LUA_NOREF if there is no
/// function or there are more arguments. May raise a Lua error (memory).
int keep_function(lua_State* L);

/// Adds an error to the diagnostics if all diagnostics of a file are wanted. False if the error must be raised.
bool keep_diagnostic(lua_State* L, Script& script, const Error& error);

/// Like `bridge`, for a declaration: true if it was made, false if its error was added to the diagnostics.
template <class Body>
bool declare(lua_State* L, Script& script, Body&& body) {
    bool made = false;
    const auto run = [&]() -> Expected<void> {
        Expected<void> ok = body();
        made = ok.has_value();
        if (!made && keep_diagnostic(L, script, ok.error())) return {};
        return ok;
    };
    bridge(L, run);
    return made;
}

}  // namespace nezumi
