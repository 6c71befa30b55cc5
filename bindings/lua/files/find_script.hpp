// Finds the script of a behaviour.
#pragma once

#include <filesystem>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/project/project.hpp"

namespace nezumi {

/// The path of the script `name`, as `Project::find` finds it, but without system files: a system often has the name of
/// a behaviour. The error has no location.
Expected<std::filesystem::path> find_script(const Project& project, std::string_view name,
                                            const std::filesystem::path& named_in);

}  // namespace nezumi
