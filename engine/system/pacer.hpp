// Ties ticks to the wall clock: absolute deadlines, so that nothing drifts.
#pragma once

#include <chrono>
#include <cstdint>

#include "engine/system/lateness.hpp"

namespace nezumi {

class Pacer {
public:
    using Clock = std::chrono::steady_clock;

    /// After a stall of more than this many periods the missed ticks are skipped instead of run in a burst.
    static constexpr int longest_burst = 5;

    /// `rate` [Hz] of the ticks in simulated time, `speed` times as fast as the wall clock (> 0). The first one is due
    /// at `start`.
    Pacer(double rate, double speed, Clock::time_point start = Clock::now());

    /// Sleeps until the next tick is due; returns at once when it is late. The tick begins then.
    void wait();
    /// When the next tick is due.
    Clock::time_point due() const;
    /// The next tick begins at `now`: counts it, and how late it is.
    void begin_tick(Clock::time_point now);
    /// Without sleeping: how long until the next tick is due; negative when it is late.
    Clock::duration until_due() const { return due() - Clock::now(); }
    /// Counts from now on, as after a pause.
    void restart(Clock::time_point now = Clock::now());

    /// Of all ticks so far.
    const Lateness& lateness() const { return lateness_; }

private:
    double rate_;
    double speed_;
    Clock::time_point start_;
    std::int64_t ticks_ = 0;  // since start_
    Lateness lateness_;
};

}  // namespace nezumi
