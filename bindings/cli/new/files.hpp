// Writes new files: all of them or none.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::cli {

struct NewFile {
    std::filesystem::path path;
    std::string text;
};

/// Writes the files and their folders. Never overwrites a file: if one exists or can't be written, none is made.
Expected<void> write_new_files(const std::vector<NewFile>& files);

}  // namespace nezumi::cli
