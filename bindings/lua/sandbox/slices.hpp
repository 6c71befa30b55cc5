// Coroutines that can pause as a whole, also from within their inner coroutines. The part between two pauses is called
// a slice.
#pragma once

#include <lua.hpp>

namespace nezumi {

enum class SliceEnd : unsigned char { paused, returned, failed };

/// Runs `coroutine` from its start (then its stack has only its function), or from where it paused. After `failed`, the
/// error is on the stack of `lua`, to be raised there; its location is already stored. Return values of the coroutine
/// are dropped. Raises an error if the time limit is reached. Call it within a protected call, on the coroutine of that
/// call.
SliceEnd run_slice(lua_State* lua, lua_State* coroutine);

/// Whether the code in `lua` may pause now: it runs in a slice, and no C function that can't wait is in between.
bool can_pause(lua_State* lua);

/// Ends the slice. A C function calls it as `return pause(...)`. The next slice begins with `go_on`, as after
/// lua_yieldk.
int pause(lua_State* lua, lua_KContext context, lua_KFunction go_on);

/// Closes the variables of a coroutine that paused or failed. Returns false, with an error on the stack of `lua`, if
/// closing fails. `closes` is true while variables are closed, and false if an error is raised before or after.
bool close_slices(lua_State* lua, lua_State* coroutine, bool& closes);

}  // namespace nezumi
