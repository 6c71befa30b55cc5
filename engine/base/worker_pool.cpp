// A round of work: wake all threads, do one share, wait for the others.
#include "engine/base/worker_pool.hpp"

#include <algorithm>
#include <chrono>
#include <system_error>

namespace nezumi {
namespace {

// Within a tick, rounds follow each other within microseconds, but sleeping and waking takes tens of microseconds. So a
// waiting thread polls this many times before it sleeps: for about 200 us, the time that one thread needs for a tick of
// a hundred robots. Meanwhile it keeps its processor: on a busy machine it would not soon get a processor again.
constexpr int patience = 10'000;

// The time a sleeping thread needs to wake.
constexpr std::chrono::microseconds waking{100};

// After a round in which the other threads were late, the caller does some rounds alone: twice as many each time, at
// most this number; one fewer after each round without delay.
constexpr int most_alone = 256;

void relax() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield");
#endif
}

template <class Done>
bool soon(const Done& done) {
    for (int i = 0; i < patience; ++i) {
        if (done()) return true;
        relax();
    }
    return done();
}

}  // namespace

WorkerPool::WorkerPool(int threads) {
    try {
        for (std::size_t worker = 1; worker < static_cast<std::size_t>(threads); ++worker) {
            threads_.emplace_back([this, worker] { serve(worker); });
        }
    } catch (const std::system_error&) {
        // The system gives no further thread: the existing ones do the work.
    }
}

WorkerPool::~WorkerPool() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void WorkerPool::run(std::size_t count, const Work& work) {
    using Clock = std::chrono::steady_clock;
    if (alone_ > 0) {
        --alone_;
        for (std::size_t worker = 0; worker < size(); ++worker) do_share(work, count, worker);
        return;
    }
    const auto began = Clock::now();
    start_round(count, work);
    do_share(work, count, 0);
    const auto done = Clock::now();
    wait_for_others();
    // On a busy machine the threads may not run; then one thread alone would have been faster.
    const bool late = Clock::now() - done > (done - began) * static_cast<int>(threads_.size()) + waking;
    late_rounds_ = late ? std::min(2 * late_rounds_ + 1, most_alone) : std::max(late_rounds_ - 1, 0);
    if (late) alone_ = late_rounds_;
}

void WorkerPool::do_share(const Work& work, std::size_t count, std::size_t worker) const {
    work(count * worker / size(), count * (worker + 1) / size(), worker);
}

void WorkerPool::start_round(std::size_t count, const Work& work) {
    {
        const std::lock_guard lock(mutex_);
        work_ = &work;
        count_ = count;
        running_ = threads_.size();
        ++round_;
    }
    wake_.notify_all();
}

void WorkerPool::wait_for_others() {
    const auto all_done = [this] { return running_ == 0; };
    if (soon(all_done)) return;
    Lock lock(mutex_);
    done_.wait(lock, all_done);
}

bool WorkerPool::has_news(std::size_t served) const { return quit_ || round_ != served; }

void WorkerPool::serve(std::size_t worker) {
    for (std::size_t served = 0;; ++served) {
        const auto news = [&] { return has_news(served); };
        if (!soon(news)) {
            Lock lock(mutex_);
            wake_.wait(lock, news);
        }
        if (quit_) return;
        do_share(*work_, count_, worker);
        if (--running_ > 0) continue;
        // Locks once: `wait_for_others` then either sleeps already, or will see `running_ == 0`. So it can't miss the
        // notification.
        { const std::lock_guard lock(mutex_); }
        done_.notify_one();
    }
}

}  // namespace nezumi
