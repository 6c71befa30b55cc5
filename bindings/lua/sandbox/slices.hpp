// Coroutines that run in slices: whatever runs in one may pause the whole, from within coroutines of its own as well.
#pragma once

#include <lua.hpp>

namespace nezumi {

enum class SliceEnd : unsigned char { paused, returned, failed };

/// Runs `coroutine` from its start (then its function is all that is on its stack), or from where it paused. After
/// `failed` the error lies on the stack of `lua`, to be raised there; its place is known. What the coroutine returns is
/// dropped. Raises the error of a budget that is used up. To be called within a protected call, on its own coroutine.
SliceEnd run_slice(lua_State* lua, lua_State* coroutine);

/// Whether what runs in `lua` may pause now: it runs in a slice, and no C function that can't wait lies in between.
bool can_pause(lua_State* lua);

/// Ends the slice, to be returned by a C function that may pause. The next slice begins with `go_on`, as after
/// lua_yieldk.
int pause(lua_State* lua, lua_KContext context, lua_KFunction go_on);

/// Closes what a coroutine that paused or failed has open. Returns false, with an error on the stack of `lua`, where a
/// closer fails. `closes` is true while closers run, and no longer when an error is raised before or after them.
bool close_slices(lua_State* lua, lua_State* coroutine, bool& closes);

}  // namespace nezumi
