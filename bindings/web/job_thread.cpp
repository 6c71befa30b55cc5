// The lock is not held while a job runs.
#include "bindings/web/job_thread.hpp"

#include <system_error>
#include <utility>

#include "engine/base/thread.hpp"

namespace nezumi::web {

JobThread::~JobThread() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    news_.notify_all();
    if (thread_.joinable()) thread_.join();
}

bool JobThread::put(std::function<void()> job) {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= most_waiting) return false;
    if (!thread_.joinable()) {
        try {
            thread_ = start_thread([this] { work(); });
        } catch (const std::system_error&) {
            return false;
        }
    }
    waiting_.push_back(std::move(job));
    news_.notify_one();
    return true;
}

void JobThread::work() {
    for (;;) {
        std::function<void()> job;
        {
            Lock lock(mutex_);
            news_.wait(lock, [&] { return ends_ || !waiting_.empty(); });
            if (ends_) return;
            job = std::move(waiting_.front());
            waiting_.pop_front();
        }
        job();
    }
}

}  // namespace nezumi::web
