// Exercises are folders: a text, the files to start with, and hidden scenarios that check the work.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::web {

struct Exercise {
    std::string name;              ///< name of its folder and of its system file
    std::filesystem::path folder;  ///< text.md, text.ja.md, start/, hidden/
    std::string text{};            ///< Markdown; the first line is the title
    std::string text_ja{};         ///< in Japanese; "" for none

    /// The project that pupils get.
    std::filesystem::path start() const { return folder / "start"; }
    /// Files that replace the pupil's when the work is checked.
    std::filesystem::path hidden() const { return folder / "hidden"; }
};

/// The path of an exercise's system file, relative to the project.
std::filesystem::path system_of(std::string_view exercise);

/// The exercises in these folders, the first of each name; sorted. A folder without text.md or without its system
/// file is not one.
std::vector<Exercise> find_exercises(const std::vector<std::filesystem::path>& folders);

/// Copies files and folders with their times, but no links and no names that begin with a dot. Existing files are
/// replaced if `replaces`, else kept. Fails at more than `most_copied` files and folders, after copying that many.
/// The error names the file.
Expected<void> copy_files(const std::filesystem::path& from, const std::filesystem::path& to, bool replaces);
inline constexpr int most_copied = 2000;

}  // namespace nezumi::web
