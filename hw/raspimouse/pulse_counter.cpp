// Accepts a reading that fits the commands. Any other reading must be confirmed by further readings.
#include "hw/raspimouse/pulse_counter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nezumi::hw {
namespace {

PulseTotals between(const PulseTotals& earlier, const PulseTotals& later) {
    return {later.forward - earlier.forward, later.backward - earlier.backward};
}

double sum(const PulseTotals& totals) { return totals.forward + totals.backward; }

// The pulses counted between two readings.
int counted(std::uint16_t earlier, std::uint16_t later) { return static_cast<std::uint16_t>(later - earlier); }

// The largest plausible count for `commanded` pulses: times are known to a few milliseconds, and a slow rate
// holds until its period ends.
double most(double commanded) { return commanded * 1.25 + 24; }

// If the count is still 0 after this number of commanded pulses, the counter can't be read.
constexpr double silent_pulses = 64;

}  // namespace

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

bool PulseCounter::agree(const Mark& earlier, const Mark& later) {
    return counted(earlier.reading, later.reading) <= most(sum(between(earlier.commanded, later.commanded)));
}

// Signed counters also count downwards.
bool PulseCounter::agree_either_way(const Mark& earlier, const Mark& later) {
    return agree(earlier, later) ||
           counted(later.reading, earlier.reading) <= most(sum(between(earlier.commanded, later.commanded)));
}

void PulseCounter::count(double pulses, const PulseTotals& meanwhile) {
    const double commanded = sum(meanwhile);
    double forward = direction_ > 0 ? pulses : 0;
    if (commanded > 0) {
        forward = std::round(pulses * meanwhile.forward / commanded);
        if ((meanwhile.backward > 0) != (meanwhile.forward > 0)) direction_ = meanwhile.forward > 0 ? 1 : -1;
    }
    pulses_ += std::llround(2 * forward - pulses);
}

PulseCounter::Verdict PulseCounter::take(std::uint16_t reading, const PulseTotals& commanded) {
    const Mark now{reading, commanded};
    if (!started_) {
        started_ = true;
        last_ = now;
        return Verdict::taken;
    }
    const PulseTotals meanwhile = between(last_.commanded, commanded);
    if (std::exchange(begins_anew_, false)) {
        count(std::round(sum(meanwhile)), meanwhile);
        last_ = now;
        return Verdict::taken;
    }
    if (agree(last_, now)) {
        // A failed reading gives 0 too. If the counter was at 0, the missing pulses show the failure.
        if (reading == 0 && last_.reading == 0 && sum(meanwhile) > silent_pulses) return Verdict::zero;
        if (reading == 0 && last_.reading == 0 && sum(meanwhile) > 0) return Verdict::taken;
        count(counted(last_.reading, reading), meanwhile);
        last_ = now;
        doubts_ = 0;
        return Verdict::taken;
    }
    if (reading == 0) return Verdict::zero;
    doubts_ = doubts_ > 0 && agree_either_way(doubted_, now) ? doubts_ + 1 : 1;
    doubted_ = now;
    if (doubts_ < readings_to_believe) return Verdict::doubted;
    count(std::round(sum(meanwhile)), meanwhile);
    last_ = now;
    doubts_ = 0;
    begins_anew_ = true;
    return Verdict::jumped;
}

}  // namespace nezumi::hw
