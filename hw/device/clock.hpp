// The clock that samples of devices are stamped with.
#pragma once

#include <chrono>

namespace nezumi::hw {

/// [s] of the monotonic clock, the same in all processes of a machine.
inline double clock_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace nezumi::hw
