// Threads that share the work for the numbers 0 to n - 1. The work for a number must not depend on the other numbers.
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
    /// `threads` includes the calling thread, so a pool of one starts no thread. Starts fewer if the system provides no
    /// more.
    explicit WorkerPool(int threads);
    ~WorkerPool();
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    std::size_t size() const { return threads_.size() + 1; }

    using Work = std::function<void(std::size_t begin, std::size_t end, std::size_t worker)>;
    /// Calls `work(begin, end, worker)` once for each of `size()` equal shares of [0, count), one of them in the
    /// calling thread, and returns when all are done. If the other threads are late, the caller does all shares itself.
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
    // The work of the latest round; written before `round_` is increased.
    const Work* work_ = nullptr;
    std::size_t count_ = 0;
    std::atomic<std::size_t> round_ = 0;
    std::atomic<std::size_t> running_ = 0;  // workers that have not finished their share
    std::atomic<bool> quit_ = false;
    std::vector<std::thread> threads_;
    // Only for the calling thread.
    int alone_ = 0;        // number of further rounds that it does alone
    int late_rounds_ = 0;  // number of rounds to do alone after a round in which the others were late
};

}  // namespace nezumi
