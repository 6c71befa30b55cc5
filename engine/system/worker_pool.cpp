// A round of work: wake everybody, do the own share, wait for the rest.
#include "engine/system/worker_pool.hpp"

namespace nezumi {

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
    Lock lock(mutex_);
    done_.wait(lock, [this] { return running_ == 0; });
}

void WorkerPool::serve(std::size_t worker) {
    std::size_t served = 0;
    Lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [&] { return quit_ || round_ != served; });
        if (quit_) return;
        served = round_;
        const auto* work = work_;
        const std::size_t begin = count_ * worker / size();
        const std::size_t end = count_ * (worker + 1) / size();
        lock.unlock();
        (*work)(begin, end, worker);
        lock.lock();
        if (--running_ == 0) done_.notify_one();
    }
}

}  // namespace nezumi
