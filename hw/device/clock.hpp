// The clock for time stamps of device samples.
#pragma once

#include <chrono>

namespace nezumi::hw {

/// The monotonic clock [s]; the same for all processes of a machine.
inline double clock_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace nezumi::hw
