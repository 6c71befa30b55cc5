// Every deadline is counted from the start, not from the tick before.
#include "engine/pacer.hpp"

#include <algorithm>
#include <cassert>
#include <thread>

namespace nezumi {

Pacer::Pacer(double rate, double speed) : rate_(rate), speed_(speed), start_(Clock::now()) {
    assert(rate > 0 && speed > 0);
}

Pacer::Clock::time_point Pacer::deadline(std::int64_t tick) const {
    const double seconds = static_cast<double>(tick) / (rate_ * speed_);
    return start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

void Pacer::restart() {
    start_ = Clock::now();
    ticks_ = 0;
}

void Pacer::set_speed(double speed) {
    assert(speed > 0);
    speed_ = speed;
    restart();
}

void Pacer::wait() {
    std::this_thread::sleep_until(deadline(ticks_));
    const std::chrono::duration<double> behind = Clock::now() - deadline(ticks_);
    const double period = 1.0 / (rate_ * speed_);
    lateness_ = std::max(0.0, behind.count());
    worst_ = std::max(worst_, lateness_);
    if (lateness_ > period / 10) ++late_;
    if (lateness_ > longest_burst * period) {
        skipped_ += static_cast<std::uint64_t>(lateness_ / period);
        restart();
    }
    ++ticks_;
}

}  // namespace nezumi
