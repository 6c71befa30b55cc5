// A thread that does jobs one after the other, for work that a tick must not wait for.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <thread>

#include "engine/base/mutex.hpp"

namespace nezumi::web {

class JobThread {
public:
    /// The largest number of waiting jobs.
    static constexpr std::size_t most_waiting = 64;

    JobThread() = default;
    /// Waits for the running job, and drops the others.
    ~JobThread();
    JobThread(const JobThread&) = delete;
    JobThread& operator=(const JobThread&) = delete;

    /// Runs the job later; the job must handle its own errors. The thread starts with the first job. False: too many
    /// jobs wait, or no thread can be started.
    bool put(std::function<void()> job);

private:
    void work();

    Mutex mutex_;
    std::condition_variable news_;
    std::deque<std::function<void()>> waiting_;
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace nezumi::web
