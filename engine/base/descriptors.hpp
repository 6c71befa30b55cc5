// What servers leave of a process's descriptors: however many connect, robots, files and consoles get theirs.
#pragma once

#include <sys/resource.h>

#include <algorithm>

namespace nezumi {

/// So many are left for robots, recordings and whatever else the run opens, and for consoles as well; at most an eighth
/// and a quarter of what a process may have.
inline constexpr rlim_t for_files = 32, for_files_and_consoles = 96;

/// Whether so many can still be opened after this one, which has the lowest number that was free.
inline bool leaves_free(int descriptor, rlim_t count) {
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return true;
    const rlim_t part = count > for_files ? 4 : 8;
    return static_cast<rlim_t>(descriptor) + std::min(count, limit.rlim_cur / part) < limit.rlim_cur;
}

}  // namespace nezumi
