// Values of a running system that are too old for its trace, computed again while the system runs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/live/past_run.hpp"

namespace nezumi {

class PastValues {
public:
    /// Begins to compute the values of these channels (`Trace::Remembered::name`) from time `from` to time `to` [s] of
    /// the last start. The error says why the past can't be computed.
    static Expected<std::unique_ptr<PastValues>> begin(RunningSystem& live, std::vector<std::string> names, double from,
                                                       double to);

    /// The computation: call its `go_on` or `go_on_beside`; then `trace` has the values.
    PastRun& run() { return *run_; }
    Trace& trace() { return run_->system().trace(); }
    /// Extends the computation up to time `to` [s]. Returns false if it belongs to another system, does not remember
    /// these channels from time `from` on, or can't reach `to`.
    bool extend(const RunningSystem& live, const std::vector<std::string>& names, double from, double to);

private:
    PastValues(std::vector<std::string> names, double from, double known, std::unique_ptr<PastRun> run)
        : names_(std::move(names)), from_(from), known_(known), run_(std::move(run)) {}

    std::vector<std::string> names_;
    double from_;
    double known_;  // [s] the time up to which all events were known at `begin`
    std::unique_ptr<PastRun> run_;
};

}  // namespace nezumi
