// Lua as the language of a system's files and behaviours.
#pragma once

#include "engine/live/script_host.hpp"

namespace nezumi {

/// For `LiveOptions::scripts`.
const ScriptHost& lua_scripts();

}  // namespace nezumi
