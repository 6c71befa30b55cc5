// Where the script that a behaviour names is.
#pragma once

#include <filesystem>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/project/project.hpp"

namespace nezumi {

/// Where the script `name` is, as `Project::find` finds it but for system files: a behaviour often has a system of its
/// own name, and no system is a script. The error has no place of its own.
Expected<std::filesystem::path> find_script(const Project& project, std::string_view name,
                                            const std::filesystem::path& named_in);

}  // namespace nezumi
