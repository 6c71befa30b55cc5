// Computes the travel of a wheel from its counter and from the commanded pulses, which the counter should agree with.
#pragma once

#include <cstdint>

#include "engine/base/mutex.hpp"

namespace nezumi::hw {

/// Pulses since the start, by direction; both only increase.
struct PulseTotals {
    double forward = 0;
    double backward = 0;
};

/// The pulses commanded to a motor: the sum of rates over time. Any thread may use it.
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

/// The counter counts the motor's pulses modulo 65536 without direction. If both directions were commanded since the
/// last reading, the pulses are divided in proportion to the commands. The count follows the commands, so a very
/// different number is an error: a torn byte (off by 256), a 0 for a failed reading, or a new starting value because
/// the module was loaded again or another program has switched the counter to signed numbers.
class PulseCounter {
public:
    enum class Verdict {
        taken,    ///< accepted; its pulses were counted
        doubted,  ///< ignored; the next reading may explain it
        zero,     ///< ignored: the 0 means that the reading failed
        /// The counter has a new starting value; the commanded pulses are counted instead. The next reading is accepted
        /// with any value, so the node may be opened again before.
        jumped,
    };

    /// Takes a reading and the pulses commanded until then. The first reading is the starting value.
    Verdict take(std::uint16_t reading, const PulseTotals& commanded);
    /// Call it after the counter was away: the next reading may have any value, and the commanded pulses are counted
    /// for the gap.
    void begin_anew() { begins_anew_ = started_; }
    /// Pulses since the first reading, forward positive.
    std::int64_t pulses() const { return pulses_; }

    /// A jump is accepted after this number of consistent readings.
    static constexpr int readings_to_believe = 3;

private:
    struct Mark {
        std::uint16_t reading = 0;
        PulseTotals commanded;
    };
    static bool agree(const Mark& earlier, const Mark& later);
    static bool agree_either_way(const Mark& earlier, const Mark& later);
    void count(double pulses, const PulseTotals& meanwhile);

    bool started_ = false;
    bool begins_anew_ = false;  // the next reading may have any value
    Mark last_;                 // the last accepted one
    Mark doubted_;              // the last ignored one
    int doubts_ = 0;            // number of readings in a row that agree with each other but not with last_
    std::int64_t pulses_ = 0;
    int direction_ = 1;  // of the last pulses
};

}  // namespace nezumi::hw
