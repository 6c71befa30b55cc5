// The one protected call through which all Lua runs.
#pragma once

#include <lua.hpp>
#include <memory>
#include <type_traits>

#include "bindings/lua/sandbox/watchdog.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// Why a call into Lua did not return. `place` is the script's line where that is known, and not part of `message`.
struct CallError : Error {
    bool over_budget = false;  ///< it ran for too long: in a headless run, the run itself could not be made
    double used_seconds = 0;   ///< of CPU time, to within the few milliseconds between two looks at the clock
};

/// What a call into Lua gives; its results are on Lua's stack.
using CallResult = tl::expected<void, CallError>;

/// Calls the function below its `arguments` on the stack, as lua_pcall does. Pops both; pushes `results` values, or as
/// many as there are for LUA_MULTRET, and nothing after an error. Costs a few tens of nanoseconds above lua_pcall.
/// May be used within a call, on the same state or another.
CallResult protected_call(lua_State* lua, int arguments, int results, Budget budget);

/// Runs `body(lua_State*)`, which may raise Lua errors: for our own work on Lua values, which may run out of memory at
/// any push of a string or table. It returns how many values on top of the stack to keep, and gets none to begin with.
/// Nothing in it may need a destructor.
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

/// Keeps the place of the error on top of a coroutine that has failed in a slice: it will be raised again elsewhere.
void note_slice_error(lua_State* coroutine, int status);

/// Keeps what is to be known of a coroutine that is about to be closed: an error of that has no place any more.
void note_closed(lua_State* coroutine);

}  // namespace nezumi
