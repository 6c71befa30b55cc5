// Work in another thread, while ticks go on: if it starts at time t, its result is available at t + latency.
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

/// One task at a time, in a separate thread. Simulated time determines when the result is available: the run waits if
/// the result is not ready in time. So a run does not depend on the speed of the machine.
template <class Result>
class DelayedTask {
public:
    /// Whether a task was started, and neither `take` has returned its result nor `finish` has dropped it.
    bool busy() const { return future_.valid(); }

    /// Starts `work`, a function without arguments. The result is due `latency` [s] from now. Must not be called
    /// while `busy`. Exceptions of `work` (of a library, or for lack of memory) become an error of `take`.
    template <class Work>
    void start(const Time& now, double latency, Work&& work) {
        assert(!busy());
        due_ = now.seconds + latency;
        // If no thread can be started, `take` does the work itself.
        future_ = std::async(std::launch::async | std::launch::deferred,
                             [work = std::forward<Work>(work)]() mutable { return run(work); });
    }

    /// The result, or nothing if it is not available yet. With `wait` (simulation): nothing before the due time; from
    /// then on, waits until the result is ready. Without (hardware): the result as soon as it is ready, also before the
    /// due time.
    std::optional<Expected<Result>> take(const Time& now, bool wait) {
        if (!busy()) return std::nullopt;
        if (wait ? now.seconds < due_ - half_a_step : !is_ready()) return std::nullopt;
        return future_.get();
    }

    /// Waits for a running task, if there is one, and drops its result.
    void finish() {
        if (busy()) static_cast<void>(future_.get());
    }

private:
    static constexpr double half_a_step = 1e-6;  // [s] times of ticks are not exact

    template <class Work>
    static Expected<Result> run(Work& work) {
        try {
            return work();
        } catch (const std::exception& thrown) {
            return failure(thrown.what());
        } catch (...) {
            return failure("failed for an unknown reason");
        }
    }

    bool is_ready() const { return future_.wait_for(std::chrono::seconds(0)) != std::future_status::timeout; }

    std::future<Expected<Result>> future_;
    double due_ = 0;
};

}  // namespace nezumi
