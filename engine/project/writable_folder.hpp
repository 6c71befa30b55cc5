// Restricts writing to the folder of the project.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/project/project.hpp"

namespace nezumi {

/// The folder in which, and below which, files may be written: that of the project; without one, the folder of `file`.
std::filesystem::path writable_folder(const Project& project, const std::string& file);

/// An error if `path`, with links resolved, is outside of the folder `home`. The error names the file `shown` and says
/// that `what` ("a system") must be saved within `home`.
Expected<void> check_is_within(const std::filesystem::path& home, const std::filesystem::path& path,
                               const std::string& shown, std::string_view what);

}  // namespace nezumi
