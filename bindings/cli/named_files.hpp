// The files that a person names on the command line: by a path, or by a name as files name each other.
#pragma once

#include <filesystem>
#include <string>

#include "engine/base/error.hpp"

namespace nezumi::cli {

/// The system file "corridor": what is at this path from the working directory, or else what `Project::find` finds in
/// the project of the working directory. A path that leads nowhere is an error with the nearest name of its folder, a
/// name one with the nearest name anywhere.
Expected<std::filesystem::path> find_system_file(const std::string& given);

/// The same for a Lua file of any kind: a system, a behaviour, a robot.
Expected<std::filesystem::path> find_lua_file(const std::string& given);

}  // namespace nezumi::cli
