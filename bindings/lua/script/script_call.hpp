// How a C function that scripts call finds its script, and what becomes of a declaration that is wrong.
#pragma once

#include <lua.hpp>
#include <utility>

#include "bindings/lua/script/script.hpp"
#include "bindings/lua/values/bridge.hpp"

namespace nezumi {

/// The script that `set_function` gave to the C function that runs.
inline Script& script_of(lua_State* L) { return *static_cast<Script*>(lua_touserdata(L, lua_upvalueindex(1))); }

/// Sets a field of the table on top of the stack to a function that knows its script. May raise a Lua error (memory).
inline void set_function(lua_State* L, Script& script, const char* name, lua_CFunction function) {
    lua_pushlightuserdata(L, &script);
    lua_pushcclosure(L, function, 1);
    lua_setfield(L, -2, name);
}

/// The line of the script that calls the C function that runs; no place when there is none.
Place caller(lua_State* L);

/// A registry reference to the function at index 2 of a global that takes at most 3 arguments; LUA_NOREF where that is
/// none, or they are more. May raise a Lua error (memory).
int keep_function(lua_State* L);

/// Keeps an error as a diagnostic, where all diagnostics of a file are wanted. False where it is to be raised.
bool keep_diagnostic(lua_State* L, Script& script, const Error& error);

/// As `bridge`, for a declaration: true when it was made, false when what is wrong with it was kept as a diagnostic.
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
