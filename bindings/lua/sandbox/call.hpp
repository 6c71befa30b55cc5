// The protected call: all Lua code runs within one.
#pragma once

#include <lua.hpp>
#include <memory>
#include <type_traits>

#include "bindings/lua/sandbox/watchdog.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// The error of a call into Lua. `place` is the line of the script if known; `message` does not contain it.
struct CallError : Error {
    bool over_budget = false;  ///< the call ran out of time, so the result depends on the machine
    double used_seconds = 0;   ///< CPU time, accurate to a few milliseconds
};

/// The result of a call into Lua; the returned values are on Lua's stack.
using CallResult = tl::expected<void, CallError>;

/// Calls the function below its `arguments` on the stack, like lua_pcall. Pops the function and the arguments. Pushes
/// `results` values, or all for LUA_MULTRET; after an error, nothing. Takes a few tens of nanoseconds more than
/// lua_pcall. Calls may be nested, on the same state or another.
CallResult protected_call(lua_State* lua, int arguments, int results, Budget budget);

/// Runs `body(lua_State*)`, which may raise Lua errors: for work on Lua values by the engine, which may run out of
/// memory whenever it pushes a string or table. `body` begins with an empty stack, and returns how many values on top
/// of the stack to keep. It must not contain objects that need destructors.
template <class Body>
CallResult protect(lua_State* lua, Budget budget, Body&& body) {
    using Callable = std::remove_reference_t<Body>;
    if (lua_checkstack(lua, 3) == 0) return tl::unexpected(CallError{{"stack overflow"}, false});
    lua_pushcfunction(lua, [](lua_State* inside) -> int {
        auto* callable = static_cast<Callable*>(lua_touserdata(inside, 1));
        lua_settop(inside, 0);
        return (*callable)(inside);
    });
    lua_pushlightuserdata(lua, const_cast<void*>(static_cast<const void*>(std::addressof(body))));
    return protected_call(lua, 1, LUA_MULTRET, budget);
}

/// Stores the location of the error on top of a coroutine that has failed, because the error is raised again elsewhere.
void note_slice_error(lua_State* coroutine, int status);

/// Stores the file in which a coroutine began, before the coroutine is closed: an error of closing has no location of
/// its own.
void note_closed(lua_State* coroutine);

}  // namespace nezumi
