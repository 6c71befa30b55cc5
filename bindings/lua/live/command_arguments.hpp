// Reads the arguments for a command of a component from Lua.
#pragma once

#include <lua.hpp>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/values/plain_data.hpp"

namespace nezumi {

/// Copies the values above the component at stack index 1; each must be plain data. Raises no error.
Expected<PlainData> read_arguments(lua_State* L, std::string_view command);

}  // namespace nezumi
