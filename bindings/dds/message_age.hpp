// The age of a message from a host with another clock.
#pragma once

#include <algorithm>

namespace nezumi::dds {

/// Estimates the difference of two clocks: the fastest message is assumed to have age 0. Clocks need not be set and may
/// drift.
class MessageAge {
public:
    /// Returns by how many [s] this message took longer than the fastest one. `sent`: [s] by the sender's monotonic
    /// clock; `now`: [s] by ours, never decreasing.
    double of(double sent, double now) {
        const double apart = now - sent;
        if (known_) least_ += drift * (now - last_);
        least_ = known_ ? std::min(least_, apart) : apart;
        known_ = true;
        last_ = now;
        return apart - least_;
    }

private:
    // The largest relative difference between the rates of two quartz clocks. Up to it, a slow sender's clock causes no
    // error.
    static constexpr double drift = 2e-4;

    bool known_ = false;
    double least_ = 0;  // [s]
    double last_ = 0;   // [s]
};

}  // namespace nezumi::dds
