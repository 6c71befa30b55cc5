// How old a message is when it comes from a host whose clock is not ours.
#pragma once

#include <algorithm>

namespace nezumi::dds {

/// Learns how two clocks differ: the message that was the quickest on its way is taken to be new. Clocks of hosts need
/// not be set, and may drift.
class MessageAge {
public:
    /// [s] that this message was longer on its way than the quickest one. `sent`: by the sender's monotonic clock;
    /// `now`: by ours. Both [s]; `now` never falls.
    double of(double sent, double now) {
        const double apart = now - sent;
        if (known_) least_ += drift * (now - last_);
        least_ = known_ ? std::min(least_, apart) : apart;
        known_ = true;
        last_ = now;
        return apart - least_;
    }

private:
    // Quartz clocks differ by less than this; a sender that runs slower by it is still understood.
    static constexpr double drift = 2e-4;

    bool known_ = false;
    double least_ = 0;  // [s]
    double last_ = 0;   // [s]
};

}  // namespace nezumi::dds
