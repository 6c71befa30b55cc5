// Converts the clock of samples to the system's time.
#pragma once

#include <algorithm>
#include <limits>

#include "engine/ports/port_base.hpp"
#include "hw/device/clock.hpp"

namespace nezumi::hw {

class TickClock {
public:
    /// Must be called in every tick. Returns the clock's time [s].
    double look(const Time& now) {
        const double clock = clock_seconds();
        // The tick starts before this call, never after, so the smallest difference is the most exact.
        offset_ = std::min(offset_, clock - now.seconds);
        return clock;
    }
    /// The system's time of a sample with the stamp `tm`, limited to the time of the present tick.
    double system_time(const Time& now, double tm) const { return std::min(now.seconds, exact_time(tm)); }
    /// The system's time of a sample, which may be later than the present tick. So differences between samples are
    /// exact.
    double exact_time(double tm) const { return tm - offset_; }

private:
    double offset_ = std::numeric_limits<double>::infinity();  // [s] the clock's value at the system's time 0
};

}  // namespace nezumi::hw
