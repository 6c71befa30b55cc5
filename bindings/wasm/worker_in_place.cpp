// A console's worker without a thread: its jobs run where they are served.
#include <cassert>
#include <chrono>
#include <utility>

#include "bindings/console/worker.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"

namespace nezumi {

const bool Worker::has_thread = false;

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
    running_ = job_ != nullptr;
}

void Worker::start_again(std::function<void()> job) { job_ = std::move(job); }

void Worker::serve_posts() {}

void Worker::revoke() {
    revoked_ = true;
    stop_ = true;
    if (job_) running_ = false;  // a job that waits is dropped
    job_ = nullptr;
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
    const CallPause pause;
    while (!revoked_) {
        if (work()) return true;  // false only for a past moment, which is computed in slices
    }
    return false;
}

}  // namespace nezumi
