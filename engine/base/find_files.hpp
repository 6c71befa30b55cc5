// Files of a folder and below, by the end of their names.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// What a search came to: files in order of their paths, and the folders that could not be read.
struct FoundFiles {
    std::vector<std::filesystem::path> files;
    std::vector<Error> errors;
};

/// Every file below `folder` whose name ends so. Names that begin with a dot are passed over; links to folders are not
/// followed, and what is no file (a pipe, a device) is none.
FoundFiles find_files(const std::filesystem::path& folder, std::string_view ending);

}  // namespace nezumi
