// A thread that reads and writes one device, so that no other thread waits for it.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <utility>

#include "engine/base/mutex.hpp"
#include "hw/device/wake.hpp"

namespace nezumi::hw {

/// The repeated work of a worker. If the thread hangs in the kernel, the job lives longer than its worker. So a job
/// must own everything that it uses, or share the ownership.
class DeviceJob {
public:
    virtual ~DeviceJob() = default;
    /// Does the present work. Returns the longest time [s] until the next call.
    virtual double run() = 0;
    /// `run` is also called when this file has data; -1: no file.
    virtual int watched_file() const { return -1; }
    /// Called last, on the same thread.
    virtual void end() {}

    /// True if `run` has not returned for `hangs_after` at `now` [s]. Any thread may call it.
    bool hangs(double now) const {
        const double since = running_since_;
        return since > 0 && now - since > hangs_after;
    }
    /// Longest normal time [s] of one run.
    static constexpr double hangs_after = 0.3;

private:
    friend class DeviceWorker;
    std::atomic<double> running_since_ = 0;  // [s] by `clock_seconds`: begin of the present `run`; 0: none
};

class DeviceWorker {
public:
    /// Time [s] to wait for a thread to end. After that the thread is abandoned, because it hangs in the kernel.
    static constexpr double patience = 1.0;

    /// Starts immediately. Throws std::system_error if no thread can be made.
    explicit DeviceWorker(std::unique_ptr<DeviceJob> job);
    ~DeviceWorker();
    DeviceWorker(const DeviceWorker&) = delete;
    DeviceWorker& operator=(const DeviceWorker&) = delete;

    /// Runs the job now, or once more if it is running. Never blocks.
    void wake() const { state_->bell.ring(); }

private:
    struct State {
        std::unique_ptr<DeviceJob> job;
        Wake bell;
        Mutex mutex;
        std::condition_variable ended;
        bool should_end = false;
        bool has_ended = false;
    };
    static void work(State& state);

    std::shared_ptr<State> state_;  // shared with the thread, which may be abandoned
};

/// A job with its running thread.
template <class Job>
class RunningJob {
public:
    explicit RunningJob(std::unique_ptr<Job> job) : job_(*job), worker_(std::move(job)) {}

    Job* operator->() const { return &job_; }
    /// Runs the job now, or once more if it is running. Never blocks.
    void wake() const { worker_.wake(); }

private:
    Job& job_;
    DeviceWorker worker_;
};

}  // namespace nezumi::hw
