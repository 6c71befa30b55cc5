// A thread that does the reading and writing of one device, so that nobody else waits for it.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <utility>

#include "engine/base/mutex.hpp"
#include "hw/device/wake.hpp"

namespace nezumi::hw {

/// What a worker does, again and again. Where its thread hangs in the kernel it outlives its worker: it must own all
/// that it uses, or share it with jobs of other threads.
class DeviceJob {
public:
    virtual ~DeviceJob() = default;
    /// Does what is to be done now. Returns after how many seconds it wants to be called again at the latest.
    virtual double run() = 0;
    /// A file that makes it run as well when there is something to read; -1: none.
    virtual int watched_file() const { return -1; }
    /// The last thing it does, on the same thread.
    virtual void end() {}

    /// Whether its `run` has not come back at `now` [s] after `hangs_after`. From any thread.
    bool hangs(double now) const {
        const double since = running_since_;
        return since > 0 && now - since > hangs_after;
    }
    /// [s] that a device may take for all that is done at once.
    static constexpr double hangs_after = 0.3;

private:
    friend class DeviceWorker;
    std::atomic<double> running_since_ = 0;  // [s] by `clock_seconds`; 0: it does not run
};

class DeviceWorker {
public:
    /// How long [s] a thread has time to end. One that hangs in the kernel for longer is left behind.
    static constexpr double patience = 1.0;

    /// Begins at once. Throws std::system_error when there can be no more threads.
    explicit DeviceWorker(std::unique_ptr<DeviceJob> job);
    ~DeviceWorker();
    DeviceWorker(const DeviceWorker&) = delete;
    DeviceWorker& operator=(const DeviceWorker&) = delete;

    /// Makes the job run now, or again when it runs. Never waits.
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

    std::shared_ptr<State> state_;  // shared with the thread, which may be left behind
};

/// A job and the thread that runs it, from now on until this goes.
template <class Job>
class RunningJob {
public:
    explicit RunningJob(std::unique_ptr<Job> job) : job_(*job), worker_(std::move(job)) {}

    Job* operator->() const { return &job_; }
    /// Makes the job run now, or again when it runs. Never waits.
    void wake() const { worker_.wake(); }

private:
    Job& job_;
    DeviceWorker worker_;
};

}  // namespace nezumi::hw
