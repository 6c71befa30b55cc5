// Threads that share out the numbers 0 to n - 1; what each number does must not depend on the others.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

#include "engine/base/mutex.hpp"

namespace nezumi {

class WorkerPool {
public:
    /// `threads` counts the calling thread too, so a pool of one starts none. Fewer, where the system gives no more.
    explicit WorkerPool(int threads);
    ~WorkerPool();
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    std::size_t size() const { return threads_.size() + 1; }

    using Work = std::function<void(std::size_t begin, std::size_t end, std::size_t worker)>;
    /// Calls `work(begin, end, worker)` once for each of `size()` even shares of [0, count), the caller's own included,
    /// and returns when all are done. While the threads are late, the caller does all shares itself.
    void run(std::size_t count, const Work& work);

private:
    void do_share(const Work& work, std::size_t count, std::size_t worker) const;
    void start_round(std::size_t count, const Work& work);
    void wait_for_others();
    void serve(std::size_t worker);
    bool has_news(std::size_t served) const;

    Mutex mutex_;
    std::condition_variable wake_;
    std::condition_variable done_;
    // Of the latest round; written before `round_` counts it.
    const Work* work_ = nullptr;
    std::size_t count_ = 0;
    std::atomic<std::size_t> round_ = 0;
    std::atomic<std::size_t> running_ = 0;  // workers that have not done their share of it
    std::atomic<bool> quit_ = false;
    std::vector<std::thread> threads_;
    // Of the caller.
    int alone_ = 0;        // rounds that it does alone from now on
    int late_rounds_ = 0;  // how many it is to do alone when the others are late
};

}  // namespace nezumi
