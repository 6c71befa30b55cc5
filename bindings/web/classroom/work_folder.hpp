// A pupil's copy of an exercise on the disk: its size, its last save, and its quota.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi::web {

/// Limits for a pupil's files. The kept versions of files have the same limit of bytes in addition.
struct Quota {
    std::uintmax_t bytes = std::uintmax_t{20} << 20;
    std::size_t files = 2000;
};

struct WorkFolder {
    // Of all files in the folder and below, without the editor's kept versions:
    std::uintmax_t bytes = 0;
    std::size_t files = 0;
    /// [s since 1970] time of the last save of a file; 0: all files are as in the exercise.
    std::int64_t last_save = 0;
};

/// Measures `project`, a copy of the folder `start`, without following links.
WorkFolder look_at_work(const std::filesystem::path& project, const std::filesystem::path& start);

/// Returns an error if `project` would exceed the quota after saving `text` as the file `name`, unless the file gets
/// shorter.
Expected<void> check_quota(const std::filesystem::path& project, std::string_view name, std::string_view text,
                           const Quota& quota);

/// The result for a folder in which a program has written too much.
struct OverQuota {
    std::string why{};        ///< one line for pupil and teacher
    std::size_t removed = 0;  ///< number of removed files
};
/// Checks the quota of files that programs have written. Unchanged files of the exercise do not count. Returns nothing
/// if the quota is kept; else removes all files that the editor can't edit: recordings, pictures, files of failed
/// scenarios.
std::optional<OverQuota> enforce_quota(const std::filesystem::path& project, const std::filesystem::path& start,
                                       const Quota& quota);

/// Removes the oldest of the editor's kept versions until they have at most `most` bytes.
void trim_versions(const std::filesystem::path& project, std::uintmax_t most);

}  // namespace nezumi::web
