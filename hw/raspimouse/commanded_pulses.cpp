// A sum that is updated whenever the rate changes.
#include "hw/raspimouse/commanded_pulses.hpp"

#include <algorithm>

namespace nezumi::hw {

PulseTotals CommandedPulses::sum(double now) const {
    PulseTotals totals = before_;
    (rate_ > 0 ? totals.forward : totals.backward) += std::abs(rate_) * std::max(0.0, now - since_);
    return totals;
}

void CommandedPulses::set_rate(int rate, double now) {
    const std::lock_guard lock(mutex_);
    before_ = sum(now);
    rate_ = rate;
    since_ = now;
}

PulseTotals CommandedPulses::until(double now) const {
    const std::lock_guard lock(mutex_);
    return sum(now);
}

}  // namespace nezumi::hw
