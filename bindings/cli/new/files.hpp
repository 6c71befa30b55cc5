// Writes files that are not there yet: all of them or none.
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

/// Writes the files and the folders they need. Nothing is ever overwritten: when one of them is there already or can't
/// be written, none is left behind.
Expected<void> write_new_files(const std::vector<NewFile>& files);

}  // namespace nezumi::cli
