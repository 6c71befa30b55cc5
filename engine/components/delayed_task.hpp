// Work beside the tick: given at t, its result is there at t + latency.
#pragma once

#include <cassert>
#include <chrono>
#include <exception>
#include <future>
#include <optional>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/ports/port.hpp"

namespace nezumi {

/// One piece of work at a time, on a thread of its own. Simulated time decides when the result comes, so that a run is
/// the same however fast the machine is: who asks too early on the clock waits.
template <class Result>
class DelayedTask {
public:
    /// Between `start` and the `take` or `finish` that gave the result.
    bool busy() const { return future_.valid(); }

    /// Starts `work`, a function without arguments, whose result is due `latency` [s] from now. It must not be busy.
    /// What it throws (a library's, or for want of memory) comes out of `take` as an error.
    template <class Work>
    void start(const Time& now, double latency, Work&& work) {
        assert(!busy());
        due_ = now.seconds + latency;
        // Where no thread can be had, `take` does the work itself.
        future_ = std::async(std::launch::async | std::launch::deferred,
                             [work = std::forward<Work>(work)]() mutable { return run(work); });
    }

    /// The result, or nothing when it is not there yet. With `wait` (simulation) it is there when it is due, and this
    /// waits for it; without (hardware) as soon as it is ready, whatever the latency.
    std::optional<Expected<Result>> take(const Time& now, bool wait) {
        if (!busy()) return std::nullopt;
        if (wait ? now.seconds < due_ - half_a_step : !is_ready()) return std::nullopt;
        return future_.get();
    }

    /// Waits for what is under way, if anything, and forgets it.
    void finish() {
        if (busy()) static_cast<void>(future_.get());
    }

private:
    static constexpr double half_a_step = 1e-6;  // [s] ticks are no exact numbers

    template <class Work>
    static Expected<Result> run(Work& work) {
        try {
            return work();
        } catch (const std::exception& thrown) {
            return failure(thrown.what());
        } catch (...) {
            return failure("failed and did not say why");
        }
    }

    bool is_ready() const { return future_.wait_for(std::chrono::seconds(0)) != std::future_status::timeout; }

    std::future<Expected<Result>> future_;
    double due_ = 0;
};

}  // namespace nezumi
