// Finds the files given on the command line, by path or by name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::cli {

/// Finds a system file. `given` is a path from the working directory, or a name such as "corridor", which is searched
/// by `Project::find` in the project of the working directory. The error for an unknown path or name has the most
/// similar one.
Expected<std::filesystem::path> find_system_file(const std::string& given);

/// Finds a behaviour's file in the same way.
Expected<std::filesystem::path> find_behavior_file(const std::string& given);

/// Finds a Lua file of any kind: a behaviour, a system, a robot, a module, otherwise all scenario files of this
/// name.
Expected<std::vector<std::filesystem::path>> find_lua_files(const std::string& given);

/// The shipped file that a project's file of this name would replace: "the shipped system behaviors/systems/flock.lua";
/// "" for none. The kind does not matter, because a name is searched in the folders of other kinds too.
std::string shipped_file_called(const std::string& name);

}  // namespace nezumi::cli
