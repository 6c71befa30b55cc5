// The pulses commanded to a motor, forward and backward: its counter should have the same number.
#pragma once

#include "engine/base/mutex.hpp"

namespace nezumi::hw {

/// Pulses since the start, by direction; both only increase.
struct PulseTotals {
    double forward = 0;
    double backward = 0;
};

/// The sum of rates over time. Any thread may use it.
class CommandedPulses {
public:
    /// Sets the rate [pulses/s] from `now` [s] on.
    void set_rate(int rate, double now);
    /// The pulses up to `now` [s].
    PulseTotals until(double now) const;

private:
    PulseTotals sum(double now) const;

    mutable Mutex mutex_;
    PulseTotals before_;
    int rate_ = 0;
    double since_ = 0;
};

}  // namespace nezumi::hw
