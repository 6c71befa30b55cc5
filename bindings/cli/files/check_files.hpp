// Checks files without running them: finds every error for which loading them would fail.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bindings/cli/files/lua_kind.hpp"
#include "engine/base/error.hpp"
#include "engine/base/find_files.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi::cli {

/// Returns all errors of a Lua file in order of their locations; empty if it would load. A system is also built, so
/// that its ports, parameters and scripts are checked, but never started. An error without a line means that the file
/// can't be read.
std::vector<Error> check_file(const std::filesystem::path& file, const LiveOptions& options);

/// Returns all errors of a text that is not in a file yet. `file` is its future path: used in errors, to find other
/// files, and to decide the kind if the text does not show it.
std::vector<Error> check_text(const std::string& text, const std::filesystem::path& file, const LiveOptions& options);

/// Finds the Lua files that the user named: by the path of a file, by a name (`find_lua_files`), or by a folder, which
/// stands for all files in it, sorted, without hidden ones. Each file is returned once. Errors: a path that does not
/// exist or is not Lua, a folder without Lua files or that can't be read.
FoundFiles lua_files(const std::vector<std::string>& paths);

}  // namespace nezumi::cli
