// Runs ticks at times of the real clock, with absolute deadlines, so that errors do not add up.
#pragma once

#include <chrono>
#include <cstdint>

#include "engine/system/lateness.hpp"

namespace nezumi {

class Pacer {
public:
    using Clock = std::chrono::steady_clock;

    /// After a stall of more than this many periods, the missed ticks are skipped instead of being run in a burst.
    static constexpr int longest_burst = 5;

    /// `rate` [Hz] is the rate of ticks in simulated time, `speed` (> 0) the factor to real time. The first tick is due
    /// at `start`.
    Pacer(double rate, double speed, Clock::time_point start = Clock::now());

    /// Sleeps until the next tick is due; returns at once if it is late. Then the tick begins.
    void wait();
    /// When the next tick is due.
    Clock::time_point due() const;
    /// The next tick begins at `now`: counts it and its lateness.
    void begin_tick(Clock::time_point now);
    /// Time until the next tick is due, without sleeping; negative if it is late.
    Clock::duration until_due() const { return due() - Clock::now(); }
    /// Starts again from now, as after a pause.
    void restart(Clock::time_point now = Clock::now());

    /// The lateness of all ticks so far.
    const Lateness& lateness() const { return lateness_; }

private:
    double rate_;
    double speed_;
    Clock::time_point start_;
    std::int64_t ticks_ = 0;  // since start_
    Lateness lateness_;
};

}  // namespace nezumi
