// Work beside the tick: given at t, done on a thread of its own, handed back at t + latency.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "engine/error.hpp"
#include "engine/port_base.hpp"

namespace nezumi {

/// For a native component that takes longer than a tick may (a marker detector): it gives its work in one execution and
/// takes what is ready in this or a later one.
///
///     Expected<void> on_execute() override {
///         if (image_.is_new()) work_.give(image_.read(), now());
///         while (auto found = work_.take(now())) publish(*found);
///         return {};
///     }
///
/// In simulated time the result of a job is handed back at the first call at or after its time + latency, never
/// earlier, and the call waits for it if need be: the same run gives the same trace, however quick the machine is. On
/// the wall clock a result is handed back as soon as it is there.
///
/// Declare it as the last member of its component, so that it ends before what the work uses.
template <class Job, class Result>
class LatentWork {
public:
    enum class Clock { simulated, wall };

    /// `work` runs on the thread of this object and may touch its job and what nobody else touches. `latency` [s] >= 0.
    /// At most `depth` >= 1 jobs are under way; one more is refused.
    LatentWork(std::function<Expected<Result>(Job&)> work, double latency, Clock clock, std::size_t depth = 1)
        : work_(std::move(work)), latency_(latency), clock_(clock), depth_(depth) {}
    LatentWork(const LatentWork&) = delete;
    LatentWork& operator=(const LatentWork&) = delete;
    ~LatentWork() {
        {
            const std::lock_guard lock(mutex_);
            quit_ = true;
        }
        changed_.notify_all();
        if (thread_.joinable()) thread_.join();
    }

    /// Begins a job. Returns false, and counts it as refused, when `depth` jobs are under way: on the wall clock those
    /// that are not done, in simulated time those whose latency has not passed, so that what is refused depends on
    /// simulated time alone.
    bool give(Job job, const Time& now) {
        std::unique_lock lock(mutex_);
        const auto under_way = std::count_if(jobs_.begin(), jobs_.end(), [&](const Entry& entry) {
            return clock_ == Clock::simulated ? now.seconds < entry.due - rounding : !entry.result.has_value();
        });
        if (static_cast<std::size_t>(under_way) >= depth_) {
            ++refused_;
            return false;
        }
        jobs_.push_back({std::move(job), now.seconds + latency_, std::nullopt, false});
        if (!thread_.joinable()) thread_ = std::thread([this] { serve(); });
        lock.unlock();
        changed_.notify_all();
        return true;
    }

    /// The result of the oldest job when its time has come, once each; nothing otherwise. A result that is an error,
    /// and an exception that the work threw, are handed back as errors.
    std::optional<Expected<Result>> take(const Time& now) {
        std::unique_lock lock(mutex_);
        if (jobs_.empty()) return std::nullopt;
        Entry& oldest = jobs_.front();
        if (clock_ == Clock::simulated) {
            if (now.seconds < oldest.due - rounding) return std::nullopt;
            changed_.wait(lock, [&] { return oldest.result.has_value(); });
        } else if (!oldest.result) {
            return std::nullopt;
        }
        std::optional<Expected<Result>> result = std::move(oldest.result);
        jobs_.pop_front();
        return result;
    }

    /// Forgets every job, as when the component stops. Waits for the one that is being worked on.
    void cancel() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return !working_; });
        jobs_.clear();
    }

    double latency() const { return latency_; }
    /// Jobs that were refused because enough were under way.
    std::size_t refused() const { return refused_; }

private:
    static constexpr double rounding =
        1e-9;  // [s] given at 0.1 with 0.05, it is due at 0.15, however that was added up

    struct Entry {
        Job job;
        double due;  // [s]
        std::optional<Expected<Result>> result;
        bool begun;
    };

    Expected<Result> do_work(Job& job) const {
        try {
            return work_(job);
        } catch (const std::exception& thrown) {
            return failure(thrown.what());
        }
    }

    void serve() {
        std::unique_lock lock(mutex_);
        while (true) {
            Entry* next = nullptr;
            changed_.wait(lock, [&] {
                for (Entry& entry : jobs_) {
                    if (!entry.begun) {
                        next = &entry;
                        break;
                    }
                }
                return quit_ || next != nullptr;
            });
            if (quit_) return;
            // A deque leaves its other elements where they are when one is added or taken at its ends, and nobody
            // takes an entry before it has a result.
            next->begun = working_ = true;
            lock.unlock();
            Expected<Result> result = do_work(next->job);
            lock.lock();
            next->result = std::move(result);
            working_ = false;
            changed_.notify_all();
        }
    }

    std::function<Expected<Result>(Job&)> work_;
    double latency_;
    Clock clock_;
    std::size_t depth_;
    std::size_t refused_ = 0;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Entry> jobs_;
    bool working_ = false;
    bool quit_ = false;
    std::thread thread_;  // begins with the first job
};

}  // namespace nezumi
