// Lua as the language of a system's files and behaviours.
#pragma once

#include <memory>

#include "bindings/lua/sandbox/coverage.hpp"
#include "engine/live/script_host.hpp"

namespace nezumi {

/// The host for scripts in Lua, for `LiveOptions::scripts`.
const ScriptHost& lua_scripts();
/// Scripts that note in `coverage` which of their lines run. `coverage` must outlive the systems.
std::unique_ptr<ScriptHost> covered_scripts(Coverage& coverage);

}  // namespace nezumi
