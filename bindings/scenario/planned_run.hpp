// One run of a plan, in this process, and what is said of it.
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

/// How a plan is carried out.
struct TestSessionOptions {
    std::uint64_t seed = 124;
    std::size_t repeat = 1;                        ///< how often each run is made; all must have the same hash
    std::size_t jobs = 1;                          ///< processes at a time
    std::filesystem::path folder = "nezumi-test";  ///< failures leave their files in folders of it
    bool update_goldens = false;                   ///< write them in place of comparing with them
    std::vector<std::filesystem::path> installed;
    std::function<LiveOptions()> systems;  ///< how systems are made
    std::string words;                     ///< options that repeating a run needs besides its name and seed
    Shard shard;                           ///< only these runs are made
    bool resume = false;                   ///< results that are kept already are not made again
    bool keep = false;                     ///< results stay for who resumes or merges; a run is lost without its own
    std::uint64_t made_with = 0;           ///< `fingerprint` of the plan
    bool is_real = false;                  ///< systems have real robots: nothing is run again by itself
    /// Is told how many of the runs that it makes are over; may be empty.
    std::function<void(std::size_t done, std::size_t all)> progress;
    /// Keeps the files of a run that failed, in a folder that is there; may be empty.
    std::function<std::unique_ptr<RunFiles>(const std::filesystem::path& folder)> files;
};

/// One run in this process; when it fails, once more to keep its files and plots (unless `quick`).
RunResult run_planned(const TestPlan& plan, const PlannedRun& run, const TestSessionOptions& options, bool quick);

/// The results of one run, made several times: they must be alike. At least one; `place` is the scenario's.
RunResult agree(std::vector<RunResult> results, const Place& place);

/// What is told of a run's result.
RunReport report_of(const TestPlan& plan, const PlannedRun& run, RunResult result, const TestSessionOptions& options);

}  // namespace nezumi
