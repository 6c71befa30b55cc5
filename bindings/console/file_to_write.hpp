// Finds the files that the console may write: those of the project.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/project/writable_folder.hpp"

namespace nezumi {

/// Parts of the messages about a file that a command writes.
struct WrittenFile {
    std::string_view word;                  ///< "save"
    std::string_view file;                  ///< "a system file"
    std::string_view what;                  ///< "a system"
    std::vector<std::string_view> endings;  ///< ".lua"; a name without any gets the first
};

/// The file for the name that a person gave. The error says why it may not be written: another ending, a folder, or a
/// place outside of `home`, also through links.
Expected<std::filesystem::path> file_to_write(const std::filesystem::path& home, const std::string& name,
                                              const WrittenFile& written);

}  // namespace nezumi
