// The arguments of a component's command, on their way out of Lua.
#pragma once

#include <lua.hpp>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/values/plain_data.hpp"

namespace nezumi {

/// Copies of what stands above the component at stack index 1, each of which must be plain data. Raises nothing.
Expected<PlainData> read_arguments(lua_State* L, std::string_view command);

}  // namespace nezumi
