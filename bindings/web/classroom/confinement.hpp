// Confines a pupil's program by the kernel: it can write to one folder only, and has no network.
#pragma once

#include <sys/resource.h>

#include <filesystem>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::web {

struct Confinement {
    std::filesystem::path work{};                   ///< a folder; all files and folders in it may be read and written
    std::vector<std::filesystem::path> readable{};  ///< files and whole folders that may be read and run
    std::vector<std::filesystem::path> devices{};  ///< folders whose devices may be used; not empty: local sockets, too
    bool by_kernel = true;                         ///< false: only the bounds below apply
};

/// Bounds of each of a pupil's processes.
inline constexpr rlim_t most_memory = rlim_t{512} << 20;        ///< [bytes] of writable memory
inline constexpr rlim_t longest_pupil_file = rlim_t{64} << 20;  ///< [bytes]
inline constexpr rlim_t most_open_files = 256;
/// Added to the niceness of a pupil's process without devices, so that the class and the teacher's programs come first.
inline constexpr int lower_priority = 10;

/// Whether this kernel can confine programs (Landlock, Linux 5.13).
bool can_confine();

/// Confines this process and the programs that it will run, permanently: only the files of `confinement`, no sockets,
/// no new links, no devices. The process must have one thread. After an error, do not run the pupil's program.
Expected<void> confine(const Confinement& confinement);

/// The parts of the system and of nezumi that a confined program needs. `program` is nezumi, `installed` are the
/// folders of its installed files. Exercises are not among them: they have hidden scenarios.
std::vector<std::filesystem::path> readable_parts(const std::filesystem::path& program,
                                                  const std::vector<std::filesystem::path>& installed);

}  // namespace nezumi::web
