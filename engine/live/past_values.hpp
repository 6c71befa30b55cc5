// Values of a running system from before what its trace keeps, computed again while it runs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/live/past_run.hpp"

namespace nezumi {

class PastValues {
public:
    /// Begins to compute what these channels, as `Trace::Remembered` names them, had from a time [s] of the last start
    /// on, up to another. An error says why the past can't be computed.
    static Expected<std::unique_ptr<PastValues>> begin(RunningSystem& live, std::vector<std::string> names, double from,
                                                       double to);

    /// `PastRun::go_on` and `go_on_beside` compute them; the trace of its system has them then.
    PastRun& run() { return *run_; }
    Trace& trace() { return run_->system().trace(); }
    /// Lets it continue to the second time [s], if it is not there yet. False if it is not of this system, or does not
    /// remember these channels from the first time on, or can't get there.
    bool extend(const RunningSystem& live, const std::vector<std::string>& names, double from, double to);

private:
    PastValues(std::vector<std::string> names, double from, double known, std::unique_ptr<PastRun> run)
        : names_(std::move(names)), from_(from), known_(known), run_(std::move(run)) {}

    std::vector<std::string> names_;
    double from_;
    double known_;  // [s] what happened up to here was known at the beginning
    std::unique_ptr<PastRun> run_;
};

}  // namespace nezumi
