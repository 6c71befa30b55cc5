// A round of work: wake everybody, do the own share, wait for the rest.
#include "engine/base/worker_pool.hpp"

namespace nezumi {
namespace {

// Rounds follow each other within microseconds while a tick is computed, and to sleep and be woken takes tens of them.
// So who waits looks so many times before it sleeps: for about 20 us. It keeps its processor meanwhile: on a busy
// machine one that was given away does not come back soon.
constexpr int patience = 1000;

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
    for (std::size_t worker = 1; worker < static_cast<std::size_t>(threads); ++worker) {
        threads_.emplace_back([this, worker] { serve(worker); });
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

void WorkerPool::run(std::size_t count, const std::function<void(std::size_t, std::size_t, std::size_t)>& work) {
    {
        const std::lock_guard lock(mutex_);
        work_ = &work;
        count_ = count;
        running_ = threads_.size();
        ++round_;
    }
    wake_.notify_all();
    work(0, count / size(), 0);
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
        (*work_)(count_ * worker / size(), count_ * (worker + 1) / size(), worker);
        if (--running_ > 0) continue;
        { const std::lock_guard lock(mutex_); }  // who waits has seen that this one was running, or sees that it is not
        done_.notify_one();
    }
}

}  // namespace nezumi
