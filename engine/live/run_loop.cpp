// The pacer keeps the deadlines; attendants get the remaining time.
#include "engine/live/run_loop.hpp"

#include <poll.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <ctime>

namespace nezumi {
namespace {

Pacer::Clock::duration duration_of(double seconds) {
    return std::chrono::duration_cast<Pacer::Clock::duration>(std::chrono::duration<double>(seconds));
}

// The last part of a wait [s], for which the pacer sleeps exactly.
constexpr double precise = 0.001;
// The time [s] before a tick in which attendants must not work.
constexpr double wake_margin = 0.0002;

}  // namespace

RunLoop::RunLoop(RunningSystem& live, const Options& options)
    : live_(live), options_(options), generation_(live.generation()) {
    assert(options.speed > 0);
    pace_anew();
}

void RunLoop::pace_anew() {
    before_ = lateness();
    pacer_.reset();
    if (std::isfinite(options_.speed)) pacer_ = std::make_unique<Pacer>(live_.system().settings().rate, options_.speed);
}

Lateness RunLoop::lateness() const {
    Lateness all = before_;
    if (pacer_ != nullptr) all.add(pacer_->lateness());
    return all;
}

void RunLoop::pause() {
    ++moves_;
    ticks_left_ = 0;
    live_.set_at_rest(is_hardware());
}

void RunLoop::resume() {
    ++moves_;
    live_.set_at_rest(false);
    if (is_paused() && pacer_ != nullptr) pacer_->restart();
    ticks_left_ = forever;
}

void RunLoop::advance(std::int64_t ticks) {
    ++moves_;
    if (is_paused() && pacer_ != nullptr) pacer_->restart();
    ticks_left_ = std::clamp<std::int64_t>(ticks, 0, forever - 1);
}

void RunLoop::set_speed(double factor) {
    assert(factor > 0);
    options_.speed = factor;
    pace_anew();
}

std::vector<LogLine> RunLoop::problems() const {
    return options_.problems != nullptr ? options_.problems->lines() : std::vector<LogLine>{};
}

bool RunLoop::ended() const {
    const System& system = live_.system();
    if (quit_ || interrupted() || system.fatal_error()) return true;
    return is_at_end() && !(works_ && stands_still() && works_());
}

void RunLoop::follow_restart() {
    if (generation_ == live_.generation()) return;
    generation_ = live_.generation();
    pace_anew();  // the tick rate may have changed
}

void RunLoop::run() {
    if (pacer_ != nullptr) pacer_->restart();
    while (next_tick()) continue;
}

bool RunLoop::next_tick() {
    while (!ended()) {
        serve_until_due();
        if (ended()) return false;
        if (stands_still()) continue;
        if (!live_.may_tick()) {
            wait_for_hosts();
            continue;
        }
        if (pacer_ == nullptr && behind_ && behind_()) {
            wait_for_files(slice, true);
            continue;
        }
        return begin_tick();
    }
    return false;
}

bool RunLoop::begin_tick() {
    for (const auto& action : before_tick_) action();
    follow_restart();
    if (ended()) return false;
    tick();
    return true;
}

double RunLoop::go_on(double seconds) {
    const auto end = Clock::now() + duration_of(seconds);
    serve(end);
    if (stands_still()) live_.between_ticks();
    follow_restart();
    while (!ended() && !stands_still() && spare_seconds() <= 0) {
        begin_tick();
        if (Clock::now() >= end) break;
    }
    if (ended()) return -1;
    return more_waits_ ? 0 : std::clamp(spare_seconds(), 0.0, longest_wait);
}

// Waits a moment for other hosts. If they are not ready then, attendants get time as in a pause.
void RunLoop::wait_for_hosts() {
    wait_for_files(slice, true);
    if (!live_.may_tick()) {
        serve(Clock::now() + duration_of(slice));
        live_.between_ticks();
        follow_restart();
        if (!ended() && !more_waits_ && !live_.may_tick()) wait_for_files(longest_wait);
    }
    if (pacer_ != nullptr && pacer_->until_due() < Clock::duration::zero()) pacer_->restart();
}

void RunLoop::tick() {
    if (pacer_ != nullptr) pacer_->wait();
    live_.tick();
    advanced_ += 1 / live_.system().settings().rate;
    if (is_advancing()) --ticks_left_;
    for (const auto& action : after_tick_) action();
}

void RunLoop::serve_until_due() {
    for (;;) {
        const auto now = Clock::now();
        const double spare = spare_seconds();
        // Attendants get some time even if ticks are always late or never wait.
        const bool starving = now - served_ > duration_of(more_waits_ ? slice : longest_wait / 2);
        if (spare < 2 * wake_margin && !starving) return;

        serve(now + duration_of(std::clamp(spare - wake_margin, wake_margin, longest_wait)));
        if (stands_still()) live_.between_ticks();
        follow_restart();
        if (ended()) return;
        const double left = spare_seconds() - wake_margin;
        if (more_waits_ && left > 0) continue;
        if (left < precise) return;
        wait_for_files(std::min(left - precise / 2, longest_wait));
    }
}

double RunLoop::spare_seconds() const {
    if (stands_still()) return longest_wait;
    return pacer_ != nullptr ? std::chrono::duration<double>(pacer_->until_due()).count() : 0;
}

void RunLoop::serve(Clock::time_point until) {
    more_waits_ = false;
    for (Attendant* attendant : attendants_) more_waits_ = attendant->serve(until) || more_waits_;
    served_ = Clock::now();
}

void RunLoop::wait_for_files(double seconds, bool of_hosts_alone) {
    std::vector<int> files;
    live_.add_files(files);
    if (!of_hosts_alone) {
        for (const Attendant* attendant : attendants_) attendant->add_files(files);
    }
    std::vector<pollfd> polled;
    polled.reserve(files.size());
    for (const int file : files) polled.push_back({.fd = file, .events = POLLIN, .revents = 0});
    const timespec timeout{.tv_sec = 0, .tv_nsec = static_cast<long>(seconds * 1e9)};  // less than 1 s
    ppoll(polled.data(), polled.size(), &timeout, nullptr);  // a signal ends it too, and the loop checks again
}

}  // namespace nezumi
