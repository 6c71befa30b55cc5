// From the clock that samples are stamped with to the time of the system.
#pragma once

#include <algorithm>
#include <limits>

#include "engine/ports/port_base.hpp"
#include "hw/device/clock.hpp"

namespace nezumi::hw {

class TickClock {
public:
    /// In every tick. Returns what the clock says.
    double look(const Time& now) {
        const double clock = clock_seconds();
        // The tick began a little before this, never after: the smallest difference is the nearest.
        offset_ = std::min(offset_, clock - now.seconds);
        return clock;
    }
    /// When something was measured whose sample has this stamp: never later than now.
    double system_time(const Time& now, double tm) const { return std::min(now.seconds, tm - offset_); }

private:
    double offset_ = std::numeric_limits<double>::infinity();  // [s] of the clock at the system's time 0
};

}  // namespace nezumi::hw
