// Keeps the functions that were running when an error occurred, with their variables.
#pragma once

#include <lua.hpp>
#include <memory>
#include <vector>

#include "engine/components/inside.hpp"

namespace nezumi {

/// Limits: functions, functions of a deep recursion, variables of each function, bytes of a text. More is left out.
inline constexpr int most_frames = 20, most_deep_frames = 5, most_locals = 30;
inline constexpr std::size_t longest_local = 200;

/// The Lua functions on the stack of a failed coroutine, whose error is on top, after those of inner coroutines; null
/// if there are none. After a deep recursion (`is_deep`), which leaves no room on the stack, only a few functions,
/// without variables. Raises no error, and uses no memory of the state except a few stack slots.
std::shared_ptr<const ErrorFrames> frames_of(lua_State* coroutine, bool is_deep = false);

/// Keeps the functions of a failed coroutine whose error, now on top of the stack of `lua`, is raised again there.
void note_inner_error(lua_State* lua, lua_State* coroutine);
/// Call this when a script has caught an error: a later error with the same text is another one.
void forget_inner_error();

/// Adds a variable with the value on top of the stack, if it has a text. Raises no error and takes no memory of the
/// state.
void add_variable(std::vector<ErrorFrames::Variable>& variables, lua_State* lua, const char* name);

}  // namespace nezumi
