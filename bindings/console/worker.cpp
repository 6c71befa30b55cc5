// The job waits on one condition variable; the ticking thread never waits.
#include "bindings/console/worker.hpp"

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <csignal>
#include <ctime>
#include <optional>
#include <utility>

#include "bindings/lua/sandbox/watchdog.hpp"

namespace nezumi {

const bool Worker::has_thread = true;

Bell::Bell() : file_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

void Bell::ring() const {
    const std::uint64_t one = 1;
    // The write fails only if the counter is full; then the file is readable anyway.
    [[maybe_unused]] const ssize_t written = ::write(file_.get(), &one, sizeof one);
}

void Bell::clear() const {
    std::uint64_t count = 0;
    [[maybe_unused]] const ssize_t got = ::read(file_.get(), &count, sizeof count);
}

bool Bell::wait(Clock::time_point until, int also) const {
    constexpr std::chrono::milliseconds without_file{1};  // polling period if no descriptor was left for the bell
    auto left = std::max(until - Clock::now(), Clock::duration{0});
    if (!file_) left = std::min<Clock::duration>(left, without_file);
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
    const timespec timeout{.tv_sec = static_cast<std::time_t>(seconds.count()),
                           .tv_nsec = static_cast<long>((left - seconds).count())};
    std::array<pollfd, 2> polled{
        {{.fd = file_.get(), .events = POLLIN, .revents = 0}, {.fd = also, .events = POLLIN, .revents = 0}}};
    return ppoll(polled.data(), polled.size(), &timeout, nullptr) > 0 || (!file_ && Clock::now() < until);
}

Worker::Worker(const Bell& bell) : bell_(&bell), thread_([this] { run(); }) {}

Worker::~Worker() { assert(!thread_.joinable()); }

void Worker::ring() {
    if (bell_ != nullptr) bell_->ring();
}

void Worker::run() {
    sigset_t all;  // signals are for the ticking thread
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);
    end_calls_when(stop_);
    Lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [this] { return job_ || closed_; });
        if (!job_) break;
        auto job = std::exchange(job_, nullptr);
        lock.unlock();
        job();
        job = nullptr;
        lock.lock();
        running_ = false;
        ring();
    }
    auto last = std::exchange(last_, nullptr);
    lock.unlock();
    if (last) last();
    last = nullptr;
    lock.lock();
    ended_ = true;
    wake_.notify_all();
}

void Worker::start(std::function<void()> job) {
    const std::lock_guard lock(mutex_);
    assert(!running_ && !closed_);
    job_ = std::move(job);
    running_ = true;
    revoked_ = false;
    stop_ = false;
    wake_.notify_all();
}

bool Worker::is_idle() const {
    const std::lock_guard lock(mutex_);
    return !running_;
}

bool Worker::serve_post(Lock& lock) {
    if (posts_.empty()) return false;
    const Post post = std::move(posts_.front());
    posts_.pop_front();
    posted_ -= post.bytes;
    wake_.notify_all();
    lock.unlock();
    post.work();
    lock.lock();
    return true;
}

void Worker::serve_posts() {
    Lock lock(mutex_);
    for (std::size_t count = posts_.size(); count > 0 && serve_post(lock); --count) continue;
}

void Worker::serve(Clock::time_point until, const std::function<bool()>& takes_more) {
    until_ = until;
    Lock lock(mutex_);
    do {
        if (takes_more && (!posts_.empty() || asked_ != nullptr)) {
            lock.unlock();
            if (!takes_more()) return;
            lock.lock();
        }
        if (serve_post(lock)) continue;
        if (asked_ == nullptr) return;
        const Work& work = *asked_;  // valid until this function ends the wait of its job
        lock.unlock();
        const std::int64_t began = thread_time();
        const bool done = work();
        const std::int64_t spent = thread_time() - began;
        lock.lock();
        spent_ += spent;
        if (!done) return;
        asked_ = nullptr;
        wake_.notify_all();
    } while (Clock::now() < until);
}

void Worker::drop_all() {
    revoked_ = true;
    stop_ = true;
    posts_.clear();
    posted_ = 0;
    asked_ = nullptr;
    wake_.notify_all();
}

void Worker::revoke() {
    const std::lock_guard lock(mutex_);
    drop_all();
}

void Worker::close(std::function<void()> last) {
    const std::lock_guard lock(mutex_);
    drop_all();
    bell_ = nullptr;
    closed_ = true;
    last_ = std::move(last);
}

bool Worker::has_ended() const {
    const std::lock_guard lock(mutex_);
    return ended_;
}

bool Worker::join(Clock::time_point until) {
    bool ended = false;
    {
        Lock lock(mutex_);
        ended = wake_.wait_until(lock, until, [this] { return ended_; });
    }
    if (ended) {
        thread_.join();
    } else {
        thread_.detach();
    }
    return ended;
}

void Worker::post(std::size_t bytes, std::function<void()> work) {
    std::optional<CallPause> pause;
    Lock lock(mutex_);
    const auto may_post = [this] { return revoked_ || posted_ < most_posted; };
    if (!may_post()) {
        pause.emplace();  // the time until a slow reader has read does not count as time of the job
        wake_.wait(lock, may_post);
    }
    if (revoked_) return;
    posts_.push_back({bytes + 64, std::move(work)});
    posted_ += bytes + 64;
    ring();
}

void Worker::start_again(std::function<void()> job) {
    const Lock lock(mutex_);
    job_ = std::move(job);
}

bool Worker::perform(const Work& work) {
    std::int64_t spent = 0;
    bool done = false;
    {
        const CallPause pause;  // the called function may read the arguments from Lua's stack
        Lock lock(mutex_);
        spent_ = 0;
        if (!revoked_) {
            asked_ = &work;
            ring();
            wake_.wait(lock, [this] { return asked_ == nullptr; });
        }
        done = !revoked_;
        spent = spent_;
    }
    charge_calls(spent);
    return done;
}

}  // namespace nezumi
