// Which files the console writes: those of its project.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/project/writable_folder.hpp"

namespace nezumi {

/// How messages speak of what a command writes.
struct WrittenFile {
    std::string_view word;                  ///< "save"
    std::string_view file;                  ///< "a system file"
    std::string_view what;                  ///< "a system"
    std::vector<std::string_view> endings;  ///< ".lua"; a name without any gets the first
};

/// The file that a person means by `name`, or why nothing may be written there: another ending, a folder, a place
/// outside of `home`, also by links.
Expected<std::filesystem::path> file_to_write(const std::filesystem::path& home, const std::string& name,
                                              const WrittenFile& written);

}  // namespace nezumi
