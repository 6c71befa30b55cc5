// Keeps the functions that were running when an error occurred, with their variables.
#pragma once

#include <lua.hpp>
#include <memory>
#include <vector>

#include "engine/components/inside.hpp"

namespace nezumi {

/// Limits: functions, variables of one, bytes of a text. More is left out.
inline constexpr int most_frames = 20, most_locals = 30;
inline constexpr std::size_t longest_local = 200;

/// The Lua functions on the stack of a failed coroutine; null if there are none. Raises no error, and uses no memory of
/// the state except a few stack slots.
std::shared_ptr<const ErrorFrames> frames_of(lua_State* coroutine);

/// Adds a variable with the value on top of the stack, if it has a text. Raises no error and takes no memory of the
/// state.
void add_variable(std::vector<ErrorFrames::Variable>& variables, lua_State* lua, const char* name);

}  // namespace nezumi
