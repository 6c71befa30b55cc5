// Performs one run of a plan in this process, and reports it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bindings/scenario/reporter.hpp"
#include "bindings/scenario/result_store.hpp"
#include "bindings/scenario/scenario_run.hpp"
#include "bindings/scenario/test_plan.hpp"

namespace nezumi {

/// Options for making the runs of a plan.
struct TestSessionOptions {
    std::uint64_t seed = 124;
    std::size_t repeat = 1;                        ///< how often each run is done; all must have the same hash
    std::size_t jobs = 1;                          ///< processes at a time
    std::filesystem::path folder = "nezumi-test";  ///< the files of failures are in subfolders of it
    bool update_goldens = false;                   ///< writes the goldens instead of comparing with them
    bool coverage = false;                         ///< results have the coverage of their runs
    std::vector<std::filesystem::path> installed;
    PeerWords peer_words{};                  ///< as in `LiveOptions`
    std::function<LiveOptions()> systems;    ///< makes systems
    const Recordings* recordings = nullptr;  ///< as in `RunSettings`
    Spectator* spectator = nullptr;          ///< as in `RunSettings`
    std::string words;                       ///< options that are needed to repeat a run, besides its name and seed
    const ProjectFiles* project_files = nullptr;  ///< in place of the disk; null: the disk. Not for scenario files
    Shard shard;                                  ///< only these runs are made
    bool resume = false;                          ///< does not repeat runs whose results exist
    bool keep = false;  ///< keeps the results for resuming or merging; without its result a run counts as not made
    std::uint64_t made_with = 0;  ///< `fingerprint` of the plan
    bool is_real = false;         ///< systems have real robots: no run is repeated automatically
    /// Called with the number of finished runs and of all runs; may be empty.
    std::function<void(std::size_t done, std::size_t all)> progress;
    /// Writes the files of a failed run into an existing folder; may be empty.
    std::function<std::unique_ptr<RunFiles>(const std::filesystem::path& folder)> files;
};

/// Makes one run in this process. If it fails, makes it again to write its files and plots (unless `quick`).
RunResult run_planned(const TestPlan& plan, const PlannedRun& run, const TestSessionOptions& options, bool quick);

/// Combines the results of one run that was made several times: they must be equal. At least one; `place` is the place
/// of the scenario.
RunResult agree(std::vector<RunResult> results, const Place& place);

/// The report about the result of a run.
RunReport report_of(const TestPlan& plan, const PlannedRun& run, RunResult result, const TestSessionOptions& options);

}  // namespace nezumi
