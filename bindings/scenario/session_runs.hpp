// The runs of a session, with their results so far.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bindings/scenario/planned_run.hpp"
#include "bindings/scenario/result_store.hpp"
#include "bindings/scenario/run_result.hpp"
#include "bindings/scenario/test_plan.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// Identifies runs by their number in the plan.
struct SessionRuns {
    SessionRuns(const TestPlan& of_plan, const TestSessionOptions& with_options);

    /// A run; for a run of a search, with the values that the search chose.
    const PlannedRun& run_of(std::size_t run) const;
    const Scenario& scenario_of(const PlannedRun& run) const { return plan.files[run.file].scenarios[run.scenario]; }

    ResultKey key_of(std::size_t run, std::size_t repetition, bool simplest = false) const;
    /// Whether results are kept. Runs of real robots are not repeatable, and only a run itself writes goldens, so these
    /// results are not kept.
    bool keeps() const { return !options.is_real && !options.update_goldens; }
    /// A result of an earlier session, if this one resumes.
    std::optional<KeptResult> find_kept(std::size_t run, std::size_t repetition, bool simplest = false) const;
    /// The result as bytes, after it was kept.
    std::string stored(std::size_t run, std::size_t repetition, RunResult result) const;

    /// Makes runs that are not in the plan, each in a separate process. Nothing if a signal interrupts.
    std::optional<std::vector<RunResult>> make_all(const std::vector<PlannedRun>& runs, bool quick) const;

    /// For each kind of failure, the number of the first failed run with drawn values. Failures of a scenario at the
    /// same place are of one kind.
    std::vector<std::size_t> first_failures() const;
    /// Whether a failure of the run can be simplified.
    bool is_drawn(std::size_t run) const;

    const TestPlan& plan;
    const TestSessionOptions& options;
    std::optional<ResultStore> keep{};
    std::vector<std::size_t> mine{};                // runs of this part, in order
    std::map<std::size_t, PlannedRun> searched{};   // runs of searches, with their values
    std::vector<std::vector<RunResult>> results{};  // of each run, one for each repetition
    std::vector<std::size_t> kept{};                // of each run: number of results from an earlier session
};

/// The result of a run, from the answer of its process.
RunResult result_of(const Expected<std::string>& answer);

}  // namespace nezumi
