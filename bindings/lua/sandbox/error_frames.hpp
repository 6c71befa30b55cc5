// Keeps the functions that were running when an error occurred, with their variables.
#pragma once

#include <lua.hpp>
#include <memory>

#include "engine/components/inside.hpp"

namespace nezumi {

/// Limits: functions, variables of one, bytes of a text. More is left out.
inline constexpr int most_frames = 20, most_locals = 30;
inline constexpr std::size_t longest_local = 200;

/// The Lua functions on the stack of a coroutine that has failed, null if there is none. Raises no error and takes no
/// memory of the state but for a few places of the stack.
std::shared_ptr<const ErrorFrames> frames_of(lua_State* coroutine);

}  // namespace nezumi
