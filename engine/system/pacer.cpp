// Runs ticks at times of the real clock. Each deadline is computed from the start, not from the previous tick.
#include "engine/system/pacer.hpp"

#include <cassert>
#include <thread>

namespace nezumi {

Pacer::Pacer(double rate, double speed, Clock::time_point start) : rate_(rate), speed_(speed), start_(start) {
    assert(rate > 0 && speed > 0);
}

Pacer::Clock::time_point Pacer::due() const {
    const double seconds = static_cast<double>(ticks_) / (rate_ * speed_);
    return start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

void Pacer::restart(Clock::time_point now) {
    start_ = now;
    ticks_ = 0;
}

void Pacer::wait() {
    std::this_thread::sleep_until(due());
    begin_tick(Clock::now());
}

void Pacer::begin_tick(Clock::time_point now) {
    const double behind = std::chrono::duration<double>(now - due()).count();
    const double period = 1.0 / (rate_ * speed_);
    lateness_.add(behind, period);
    if (behind > longest_burst * period) {
        lateness_.skip(static_cast<std::uint64_t>(behind / period));
        restart(now);
    }
    ++ticks_;
}

}  // namespace nezumi
