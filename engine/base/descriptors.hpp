// Reserves file descriptors, so that many clients of a server can't use those for robots, files and consoles.
#pragma once

#include <sys/resource.h>

#include <algorithm>

namespace nezumi {

/// Number of descriptors that servers leave for robots, recordings and other files, and for these and consoles; at most
/// an eighth and a quarter of the limit of the process.
inline constexpr rlim_t for_files = 32, for_files_and_consoles = 96;

/// Whether `count` more can be opened after this one, which has the lowest free number.
inline bool leaves_free(int descriptor, rlim_t count) {
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return true;
    const rlim_t part = count > for_files ? 4 : 8;
    return static_cast<rlim_t>(descriptor) + std::min(count, limit.rlim_cur / part) < limit.rlim_cur;
}

}  // namespace nezumi
