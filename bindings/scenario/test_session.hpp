// A session of scenarios: plans, runs each in a process of its own, simplifies random failures, reports.
#pragma once

#include <filesystem>
#include <vector>

#include "bindings/scenario/measures.hpp"
#include "bindings/scenario/plan_file.hpp"
#include "bindings/scenario/planned_run.hpp"
#include "bindings/scenario/reporter.hpp"
#include "bindings/scenario/test_plan.hpp"

namespace nezumi {

/// What a session came to.
struct SessionEnd {
    SessionSummary summary;
    std::vector<RunReport> reports;
    std::vector<MeasuredRun> measured;  ///< every run that was made, as it was planned
    bool interrupted = false;
    bool can_resume = false;  ///< it was interrupted, and results are kept of runs that were over

    /// 0: all passed, 1: a scenario failed, 2: something could not be run.
    int status() const {
        if (interrupted || summary.could_not_run > 0) return 2;
        return summary.failed > 0 ? 1 : 0;
    }
};

/// Makes all runs of a plan and tells the reporter of each, in order. The result does not depend on the jobs.
/// Each result is kept in `folder` as soon as there is one; at the end of all its runs a session takes them away,
/// unless it is to `keep` them.
SessionEnd run_tests(const TestPlan& plan, const TestSessionOptions& options, Reporter& reporter);

/// Tells of the runs that others have made, as `run_tests` would have. `folders` are theirs; a run whose result is in
/// none of them could not be run.
SessionEnd merge_tests(const KeptPlan& plan, const std::vector<std::filesystem::path>& folders, Reporter& reporter);

}  // namespace nezumi
