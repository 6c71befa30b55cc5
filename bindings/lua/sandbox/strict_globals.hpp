// Refuses unknown globals at run time, in addition to the check of the text (`check_globals`).
#pragma once

#include <lua.hpp>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// Makes reading a missing global, or assigning a new one, an error with the nearest name. Only the `callbacks` may be
/// assigned; an undefined callback is nil. Call it for the main thread of a state, after all its globals are set.
Expected<void> make_globals_strict(lua_State* lua, const std::vector<std::string_view>& callbacks);

}  // namespace nezumi
