// Finds what is wrong with files without running them: everything for which they would be refused when they load.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bindings/cli/files/lua_kind.hpp"
#include "engine/base/error.hpp"
#include "engine/base/find_files.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi::cli {

/// All that is wrong with one Lua file, in order of place; empty when it would load. A system is built as well, so that
/// its ports, parameters and scripts are checked, and never started. An error without a line says that the file can't
/// be read.
std::vector<Error> check_file(const std::filesystem::path& file, const LiveOptions& options);

/// The same for a text that is not in a file yet: `file` is what it is to be, which decides what errors call it, where
/// the names in it are looked up and, where its words don't say it, what kind it is.
std::vector<Error> check_text(const std::string& text, const std::filesystem::path& file, const LiveOptions& options);

/// The Lua files that a person names: files as they are or by `find_lua_files`, and of folders all that is in them and
/// below, sorted, without hidden ones. Every file once. The errors name paths that are not there or no Lua, and folders
/// without Lua files or that can't be read.
FoundFiles lua_files(const std::vector<std::string>& paths);

}  // namespace nezumi::cli
