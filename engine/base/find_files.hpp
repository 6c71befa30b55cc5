// Finds files in a folder and below, by the end of their names.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// The result of a search: files sorted by path, and folders that could not be read.
struct FoundFiles {
    std::vector<std::filesystem::path> files;
    std::vector<Error> errors;
};

/// All files below `folder` whose names end with this text. Skips names that begin with a dot, does not follow links to
/// folders, and omits everything that is not a file (pipes, devices).
FoundFiles find_files(const std::filesystem::path& folder, std::string_view ending);

}  // namespace nezumi
