// How a C function that scripts call finds its script, and raises what went wrong.
#pragma once

#include <lua.hpp>
#include <utility>

#include "bindings/lua/script/script.hpp"

namespace nezumi {

/// The script that `set_word` gave to the C function that runs.
inline Script& script_of(lua_State* L) { return *static_cast<Script*>(lua_touserdata(L, lua_upvalueindex(1))); }

/// Sets a field of the table on top of the stack to a function that knows its script. May raise a Lua error (memory).
inline void set_word(lua_State* L, Script& script, const char* name, lua_CFunction function) {
    lua_pushlightuserdata(L, &script);
    lua_pushcclosure(L, function, 1);
    lua_setfield(L, -2, name);
}

/// Runs `body()`, which reads from Lua without raising and returns an `Expected<void>`; raises its error as a Lua error
/// at the line of the caller once nothing is left that needs a destructor.
template <class Body>
int finish(lua_State* L, Script& script, Body&& body) {
    bool failed = false;
    {
        Expected<void> ok = body();
        if (!ok) {
            script.raised = std::move(ok.error().message);
            failed = true;
        }
    }
    return failed ? script.raise(L) : 0;
}

/// The line of the script that calls the C function that runs; no place when there is none.
Place caller(lua_State* L);

/// Keeps `script.raised` as a slip, where all slips of a file are wanted. False where it is to be raised.
bool keep_slip(lua_State* L, Script& script);

/// As `finish`, for a declaration: true when it was made, false when what is wrong with it was kept as a slip.
template <class Body>
bool finish_declaration(lua_State* L, Script& script, Body&& body) {
    bool failed = false;
    {
        Expected<void> ok = body();
        if (!ok) {
            script.raised = std::move(ok.error().message);
            failed = true;
        }
    }
    if (failed && !keep_slip(L, script)) script.raise(L);
    return !failed;
}

}  // namespace nezumi
