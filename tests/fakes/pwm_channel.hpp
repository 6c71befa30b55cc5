// A motor's pulse generator: a new rate is taken when the running period is over.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace nezumi::fakes {

class PwmChannel {
public:
    /// At `now` [s] somebody wants this rate [pulses/s].
    void write(int rate, double now) {
        settle(now);
        if (rate_ == 0) {
            rate_ = rate;
            since_ = now;
            return;
        }
        next_ = rate;
        next_at_ = since_ + (std::floor((now - since_) * std::abs(rate_)) + 1) / std::abs(rate_);
    }
    /// The rate at `now`.
    int rate(double now) {
        settle(now);
        return rate_;
    }
    /// Pulses made until `now`, in either direction.
    std::int64_t pulses(double now) {
        settle(now);
        return pulses_ + made(now);
    }
    /// The same, backward ones taken away.
    std::int64_t balance(double now) {
        settle(now);
        return balance_ + (rate_ < 0 ? -made(now) : made(now));
    }
    /// Since when its rate is 0; nothing while it is another, or is about to be.
    std::optional<double> still_since(double now) {
        settle(now);
        if (next_ == 0) return next_at_;
        if (rate_ != 0 || next_) return std::nullopt;
        return since_;
    }

private:
    std::int64_t made(double until) const {
        return static_cast<std::int64_t>((until - since_) * std::abs(rate_) + 1e-6);
    }
    void settle(double now) {
        if (!next_ || now < next_at_) return;
        const std::int64_t pulses = made(next_at_);
        pulses_ += pulses;
        balance_ += rate_ < 0 ? -pulses : pulses;
        rate_ = *next_;
        since_ = next_at_;
        next_.reset();
    }

    int rate_ = 0;
    double since_ = 0;
    std::int64_t pulses_ = 0, balance_ = 0;  // until since_
    std::optional<int> next_;
    double next_at_ = 0;
};

}  // namespace nezumi::fakes
