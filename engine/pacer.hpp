// Ties ticks to the wall clock: absolute deadlines, so that nothing drifts.
#pragma once

#include <chrono>
#include <cstdint>

namespace nezumi {

class Pacer {
public:
    using Clock = std::chrono::steady_clock;

    /// After a stall of more than this many periods the missed ticks are skipped instead of run in a burst.
    static constexpr int longest_burst = 5;

    /// `rate` [Hz] of the ticks in simulated time, `speed` times as fast as the wall clock (> 0).
    Pacer(double rate, double speed);

    /// Sleeps until the next tick is due; returns at once when it is late.
    void wait();
    /// Without sleeping: how long until the next tick is due; negative when it is late.
    Clock::duration until_due() const { return deadline(ticks_) - Clock::now(); }
    /// Counts from now on, as after a pause.
    void restart();
    /// Another speed from now on.
    void set_speed(double speed);
    double speed() const { return speed_; }

    /// Ticks that began later than a tenth of a period after they were due.
    std::uint64_t late() const { return late_; }
    /// Ticks that were skipped after stalls.
    std::uint64_t skipped() const { return skipped_; }
    /// How late the latest tick began [s].
    double lateness() const { return lateness_; }
    /// The worst of all [s].
    double worst_lateness() const { return worst_; }

private:
    Clock::time_point deadline(std::int64_t tick) const;

    double rate_;
    double speed_;
    Clock::time_point start_;
    std::int64_t ticks_ = 0;  // since start_
    std::uint64_t late_ = 0;
    std::uint64_t skipped_ = 0;
    double lateness_ = 0;
    double worst_ = 0;
};

}  // namespace nezumi
