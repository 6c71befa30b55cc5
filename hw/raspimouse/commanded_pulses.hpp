// How many pulses a motor has been told to make, forward and backward: what its counter should have counted.
#pragma once

#include "engine/base/mutex.hpp"

namespace nezumi::hw {

/// Pulses since the start by direction; both grow.
struct PulseTotals {
    double forward = 0;
    double backward = 0;
};

/// The sum of rates over time. Any thread may ask.
class CommandedPulses {
public:
    /// From `now` [s] on this rate [pulses/s] holds.
    void set_rate(int rate, double now);
    /// Until `now` [s].
    PulseTotals until(double now) const;

private:
    PulseTotals sum(double now) const;

    mutable Mutex mutex_;
    PulseTotals before_;
    int rate_ = 0;
    double since_ = 0;
};

}  // namespace nezumi::hw
