// A past execution of a behaviour, computed and traced again beside the running system.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "engine/live/explain.hpp"
#include "engine/live/past_run.hpp"

namespace nezumi {

class PastExecution {
public:
    /// Begins to compute the last execution of a behaviour, or the one that failed if the behaviour is in ERROR. The
    /// error says why there was no execution, or why the past can't be computed.
    static Expected<std::unique_ptr<PastExecution>> begin(RunningSystem& live, std::string_view component);

    /// The computation: call its `go_on` until it reaches the moment before the execution.
    PastRun& run() { return *run_; }
    /// [s] The time of the execution.
    double seconds() const { return seconds_; }
    /// Repeats the execution and explains it. Call this once, when `run` has reached the moment.
    Expected<Explanation> explain();

private:
    PastExecution(std::string component, double seconds, std::unique_ptr<PastRun> run)
        : component_(std::move(component)), seconds_(seconds), run_(std::move(run)) {}

    std::string component_;
    double seconds_;
    std::unique_ptr<PastRun> run_;
};

}  // namespace nezumi
