// Where the script that a behaviour names is.
#pragma once

#include <filesystem>
#include <map>
#include <string_view>

#include "bindings/lua/project/project.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// Where the script `name` is, as `Project::find` finds it but for system files: a behaviour often has a system of its
/// own name, and no system is a script. The error has no place of its own.
Expected<std::filesystem::path> find_script(const Project& project, std::string_view name,
                                            const std::filesystem::path& named_in);

/// Which files were found to be systems: for whoever finds many scripts at a time, each is read once.
using SystemsSeen = std::map<std::filesystem::path, bool>;
Expected<std::filesystem::path> find_script(const Project& project, std::string_view name,
                                            const std::filesystem::path& named_in, SystemsSeen& seen);

}  // namespace nezumi
