// What every sub-command takes from around it: the installed files, the simulator, the way to speak.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "bindings/lua/live/live_system.hpp"
#include "engine/base/error.hpp"

namespace nezumi::cli {

/// The folder of the installed files, which has `behaviors/` and `engine/robots/`; none where they are not installed.
std::vector<std::filesystem::path> installed_folders();

/// How systems are made here: simulated, from the project's files and the installed ones.
LiveOptions simulated_systems();

/// Says on standard error why something can't be done: one plain line. Returns `kCouldNotRun`.
int refuse(std::string_view why);
int refuse(const Error& error);

}  // namespace nezumi::cli
