// From what a wheel's counter says to how far the wheel has turned.
#pragma once

#include <cstdint>

#include "hw/raspimouse/commanded_pulses.hpp"

namespace nezumi::hw {

/// The counter counts the motor's pulses modulo 65536 and knows no direction: that is the command's, in the proportion
/// of what was commanded meanwhile. It counts what the motor is told, so a number that is far from that is not to be
/// believed: a byte torn in the middle of a reading (256 off), a 0 that stands for a failed reading, or a counter that
/// counts from elsewhere because its module was loaded anew or another program has switched it to signed numbers.
class PulseCounter {
public:
    enum class Verdict {
        taken,    ///< the pulses have been counted
        doubted,  ///< left out; the next reading may show what it was
        zero,     ///< the reading failed: a 0 that can't be
        /// It counts from elsewhere now, and the pulses of the jump are those that were commanded. The next reading is
        /// taken as it is: the node may be opened again before it.
        jumped,
    };

    /// Takes a reading, and what was commanded until then. The first sets the beginning.
    Verdict take(std::uint16_t reading, const PulseTotals& commanded);
    /// The next reading may count from anywhere: the counter was away. Its pulses are those commanded meanwhile.
    void begin_anew() { begins_anew_ = started_; }
    /// Pulses since the first reading, forward positive.
    std::int64_t pulses() const { return pulses_; }

    /// So many readings after a jump agree before it is believed.
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
    bool begins_anew_ = false;  // the next reading counts from anywhere
    Mark last_;                 // the last one taken
    Mark doubted_;              // the last one doubted
    int doubts_ = 0;            // readings in a row that agree with each other, not with last_
    std::int64_t pulses_ = 0;
    int direction_ = 1;  // of the last pulses
};

}  // namespace nezumi::hw
