// Restricts writing to the folder of the project.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/project/project.hpp"

namespace nezumi {

/// The folder in which files may be written, also below it: the project, otherwise the folder of this file.
std::filesystem::path writable_folder(const Project& project, const std::string& file);

/// An error if `path` is outside of the folder `home`, also through links. It names the file `shown` and says that
/// `what` ("a system") must be saved within.
Expected<void> check_is_within(const std::filesystem::path& home, const std::filesystem::path& path,
                               const std::string& shown, std::string_view what);

}  // namespace nezumi
