// Globals that a script can't invent: the net under `check_globals`, at run time.
#pragma once

#include <lua.hpp>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// From now on reading a global that is not there, or assigning a new one, is an error with the nearest name. Only the
/// `callbacks` may be assigned; one that is not defined reads as nil. For the main thread of a state, once its globals
/// hold all words.
Expected<void> make_globals_strict(lua_State* lua, const std::vector<std::string_view>& callbacks);

}  // namespace nezumi
