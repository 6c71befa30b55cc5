// A pupil's copy of an exercise on the disk: its size, its last save, and how much it may have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
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
    std::uintmax_t bytes = 0;  ///< of the files below
    std::size_t files = 0;     ///< without hidden ones
    /// [s since 1970] when a file was last saved; 0: all are as in the exercise.
    std::int64_t last_save = 0;
};

/// Looks at `project`, a copy of the folder `start`, without following links.
WorkFolder look_at_work(const std::filesystem::path& project, const std::filesystem::path& start);

/// An error if `project` had too much after the file `name` was saved with `text`, unless the file gets shorter.
Expected<void> check_quota(const std::filesystem::path& project, std::string_view name, std::string_view text,
                           const Quota& quota);

/// Removes the oldest of the editor's kept versions until they have at most `most` bytes.
void trim_versions(const std::filesystem::path& project, std::uintmax_t most);

}  // namespace nezumi::web
