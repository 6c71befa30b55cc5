// A session of scenarios: performs each run in a separate process, simplifies random failures, and reports.
#pragma once

#include <filesystem>
#include <vector>

#include "bindings/scenario/coverage_report.hpp"
#include "bindings/scenario/measures.hpp"
#include "bindings/scenario/plan_file.hpp"
#include "bindings/scenario/planned_run.hpp"
#include "bindings/scenario/reporter.hpp"
#include "bindings/scenario/test_plan.hpp"

namespace nezumi {

/// The result of a session.
struct SessionEnd {
    SessionSummary summary;
    std::vector<RunReport> reports;
    std::vector<MeasuredRun> measured;  ///< every run that was made, as it was planned
    CoverageReport coverage{};          ///< of the same runs, if coverage is on
    bool interrupted = false;
    bool can_resume = false;  ///< it was interrupted, and results of finished runs are kept

    /// 0: all passed, 1: a scenario failed, 2: something could not be run.
    int status() const {
        if (interrupted || summary.could_not_run > 0) return 2;
        return summary.failed > 0 ? 1 : 0;
    }
};

/// Makes all runs of a plan and reports each, in order. The result does not depend on the number of jobs. Each result
/// is kept in `folder` as soon as it exists. After the last run the results are removed, unless the option `keep` is
/// set.
SessionEnd run_tests(const TestPlan& plan, const TestSessionOptions& options, Reporter& reporter);

/// Reports the runs that other sessions have made, as `run_tests` would have. `folders` are their folders. A run
/// without a result in any of them counts as not made.
SessionEnd merge_tests(const KeptPlan& plan, const std::vector<std::filesystem::path>& folders, Reporter& reporter);

}  // namespace nezumi
