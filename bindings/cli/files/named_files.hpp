// The files that a person names on the command line: by a path, or by a name as files name each other.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::cli {

/// The system file "corridor": what is at this path from the working directory, or else what `Project::find` finds in
/// the project of the working directory. A path that leads nowhere is an error with the nearest path, a name one with
/// the nearest name anywhere.
Expected<std::filesystem::path> find_system_file(const std::string& given);

/// The same for a Lua file of any kind: a behaviour, a system, a robot, a module, or else all scenario files of the
/// name.
Expected<std::vector<std::filesystem::path>> find_lua_files(const std::string& given);

/// What a file of this name in a project would be found in place of: "the shipped system behaviors/systems/flock.lua";
/// "" for nothing. Kinds don't matter, as a name of one is looked for in the folders of others as well.
std::string shipped_file_called(const std::string& name);

}  // namespace nezumi::cli
