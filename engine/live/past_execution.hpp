// An execution of a behaviour that is over, computed and traced again beside the running system.
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
    /// Begins to compute the last execution of a behaviour; of one in ERROR, the one that failed. An error says why
    /// there is none, or why the past can't be computed.
    static Expected<std::unique_ptr<PastExecution>> begin(RunningSystem& live, std::string_view component);

    /// `PastRun::go_on` goes to the moment before the execution.
    PastRun& run() { return *run_; }
    /// [s] The time of the execution.
    double seconds() const { return seconds_; }
    /// Executes it, once, when the moment is reached.
    Expected<Explanation> explain();

private:
    PastExecution(std::string component, double seconds, std::unique_ptr<PastRun> run)
        : component_(std::move(component)), seconds_(seconds), run_(std::move(run)) {}

    std::string component_;
    double seconds_;
    std::unique_ptr<PastRun> run_;
};

}  // namespace nezumi
