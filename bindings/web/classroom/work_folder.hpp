// A pupil's copy of an exercise on the disk: its size, its last save, and how much it may have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi::web {

/// What a pupil's files may have. Kept versions of files may have as many bytes again.
struct Quota {
    std::uintmax_t bytes = std::uintmax_t{20} << 20;
    std::size_t files = 2000;
};

struct WorkFolder {
    // All files below, but without the editor's kept versions:
    std::uintmax_t bytes = 0;
    std::size_t files = 0;
    /// [s since 1970] when a file was last saved; 0: all are as in the exercise.
    std::int64_t last_save = 0;
};

/// Looks at `project`, a copy of the folder `start`, without following links.
WorkFolder look_at_work(const std::filesystem::path& project, const std::filesystem::path& start);

/// An error if `project` had too much after the file `name` was saved with `text`, unless the file gets shorter.
Expected<void> check_quota(const std::filesystem::path& project, std::string_view name, std::string_view text,
                           const Quota& quota);

/// What became of a folder in which a program has written too much.
struct OverQuota {
    std::string why{};        ///< one line for pupil and teacher
    std::size_t removed = 0;  ///< files
};
/// The same for what was written in any other way than by the editor; nothing if it fits. Files as in the exercise do
/// not count. Otherwise all files that are not texts of the editor are removed: recordings, pictures, what failed
/// scenarios left.
std::optional<OverQuota> enforce_quota(const std::filesystem::path& project, const std::filesystem::path& start,
                                       const Quota& quota);

/// Removes the oldest of the editor's kept versions until they have at most `most` bytes.
void trim_versions(const std::filesystem::path& project, std::uintmax_t most);

}  // namespace nezumi::web
