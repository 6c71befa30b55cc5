// The globals of tasks: task, start, cancel, wait, wait_until.
#pragma once

#include <lua.hpp>
#include <string_view>

#include "bindings/lua/script/script.hpp"

namespace nezumi {

bool is_task_global(std::string_view name);

/// Sets these functions in the table of globals, which is on top of the stack. May raise a Lua error (memory).
void set_task_globals(lua_State* L, Script& script);

}  // namespace nezumi
