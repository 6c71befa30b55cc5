// Waits for what other processes do.
#pragma once

#include <unistd.h>

#include <functional>

#include "hw/device/clock.hpp"

namespace nezumi::hw {

/// True as soon as `condition` is; false if it is not within so many seconds.
inline bool holds_within(double seconds, const std::function<bool()>& condition) {
    const double end = clock_seconds() + seconds;
    while (clock_seconds() < end) {
        if (condition()) return true;
        usleep(2000);
    }
    return condition();
}

}  // namespace nezumi::hw
