// A console's worker without a thread: its jobs run where they are served.
#include <cassert>
#include <chrono>
#include <utility>

#include "bindings/console/worker.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"
#include "bindings/wasm/in_place.hpp"

namespace nezumi {
namespace {

web::TickInPlace& tick() {
    static web::TickInPlace the;
    return the;
}

}  // namespace

void web::tick_in_place_by(TickInPlace by) { tick() = std::move(by); }

Bell::Bell() = default;
void Bell::ring() const {}
void Bell::clear() const {}
bool Bell::wait(Clock::time_point /*until*/, int /*also*/) const { return false; }

Worker::Worker(const Bell& bell) : bell_(&bell) {}
Worker::~Worker() = default;

void Worker::start(std::function<void()> job) {
    assert(!running_ && !closed_);
    job_ = std::move(job);
    running_ = true;
    revoked_ = false;
    stop_ = false;
}

bool Worker::is_idle() const { return !running_; }

void Worker::serve(Clock::time_point /*until*/, const std::function<bool()>& /*takes_more*/) {
    if (!job_) return;
    end_calls_when(stop_);
    std::exchange(job_, nullptr)();
    running_ = false;
}

void Worker::serve_posts() {}

void Worker::revoke() {
    revoked_ = true;
    stop_ = true;
}

void Worker::close(std::function<void()> last) {
    revoke();
    closed_ = true;
    if (last) last();
    ended_ = true;
}

bool Worker::has_ended() const { return ended_; }
bool Worker::join(Clock::time_point /*until*/) { return ended_; }

void Worker::post(std::size_t /*bytes*/, std::function<void()> work) {
    if (!revoked_) work();
}

bool Worker::perform(const Work& work) {
    constexpr std::chrono::seconds patience{20};
    const CallPause pause;
    // A command that waits for ticks gets them; one that computes a past moment is asked again.
    for (auto end = Clock::now() + patience; !revoked_ && Clock::now() < end;) {
        if (work()) return true;
        if (tick() && tick()()) end = Clock::now() + patience;
    }
    return false;
}

}  // namespace nezumi
