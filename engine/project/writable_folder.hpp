// Where a project's own words may write: in it, and nowhere else.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/project/project.hpp"

namespace nezumi {

/// The folder in and below which files may be written: the project, else the folder of this file of it.
std::filesystem::path writable_folder(const Project& project, const std::string& file);

/// An error when `path` lies outside of the folder `home`, also by links. It calls the file `shown` and says that
/// `what` ("a system") is saved within.
Expected<void> check_is_within(const std::filesystem::path& home, const std::filesystem::path& path,
                               const std::string& shown, std::string_view what);

}  // namespace nezumi
