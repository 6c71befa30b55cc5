// What a pupil's program can reach: the kernel allows it one folder to write, and no network.
#pragma once

#include <sys/resource.h>

#include <filesystem>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::web {

struct Confinement {
    std::filesystem::path work{};                   ///< files and folders below may be read and written
    std::vector<std::filesystem::path> readable{};  ///< files, or folders with all below: may be read and run
    std::vector<std::filesystem::path> devices{};   ///< folders: devices below may be used, and local sockets
    bool by_kernel = true;                          ///< false: only the bounds below hold
};

/// Bounds of each of a pupil's processes.
inline constexpr rlim_t most_memory = rlim_t{512} << 20;        ///< [bytes] that it writes to
inline constexpr rlim_t longest_pupil_file = rlim_t{64} << 20;  ///< [bytes]
inline constexpr rlim_t most_open_files = 256;
/// Added to its niceness unless it has devices: the class and the teacher's programs come first.
inline constexpr int lower_priority = 10;

/// Whether this kernel can confine programs (Landlock, Linux 5.13).
bool can_confine();

/// Confines this process, and the programs that it will run, for good: files as said, no sockets, no links, no devices.
/// Needs a process with one thread. An error gives the reason; then nothing may be run.
Expected<void> confine(const Confinement& confinement);

/// The parts of the system and of nezumi that a confined program needs. `program` is nezumi, `installed` are the
/// folders of its installed files. Exercises are not among them: they have hidden scenarios.
std::vector<std::filesystem::path> readable_parts(const std::filesystem::path& program,
                                                  const std::vector<std::filesystem::path>& installed);

}  // namespace nezumi::web
