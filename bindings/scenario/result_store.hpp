// Stores the results of runs in a folder, a file for each, for sessions that resume or merge.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "bindings/scenario/run_result.hpp"
#include "bindings/scenario/test_plan.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// A part of the runs of a plan: every `count`th run, so that long runs are spread over all parts.
struct Shard {
    std::size_t index = 1;  ///< 1 to `count`
    std::size_t count = 1;

    bool has(std::size_t run) const { return run % count == index - 1; }
};

/// A hash of everything that a run depends on: the version, the seed, and the files that it may read. These are all
/// files of the project's `behaviors/`, and in the folders of the scenario files (`tests/`) Lua, CSV tables, maps and
/// pictures that no session has written. Results with another fingerprint do not belong to this plan.
std::uint64_t fingerprint(const TestPlan& plan, std::uint64_t seed, const std::string& version,
                          const std::vector<std::filesystem::path>& installed);

/// Identifies a result.
struct ResultKey {
    std::string file;              ///< as the plan shows it
    std::string run;               ///< its name
    std::uint64_t repetition = 0;  ///< number of `--repeat`
    bool simplest = false;         ///< not the run itself, but the simplest failure that was found from it
    std::uint64_t seed = 0;        ///< of the run
};

/// A result, and the name and seed of its run. For a simplest failure, this is not the planned run.
struct KeptResult {
    std::string name;
    RunResult result;
    std::uint64_t seed = 0;
};

/// Files are written completely or not at all. Several processes may write at the same time if each has its own runs.
class ResultStore {
public:
    /// Uses the folder `results/` of the folder for failures.
    ResultStore(std::filesystem::path folder, std::uint64_t made_with)
        : folder_(std::move(folder)), made_with_(made_with) {}

    Expected<void> keep(const ResultKey& key, const KeptResult& result) const;
    /// Nothing if there is no result, if it is damaged, or if it has another fingerprint. The folder of a failure's
    /// files is relative to the present folder.
    std::optional<KeptResult> find(const ResultKey& key) const;
    void forget(const ResultKey& key) const;
    /// Removes the folder of the files if it is empty, and with `with_parent` also its parent.
    void remove_if_empty(bool with_parent) const;

    /// The folder of the files.
    static std::filesystem::path folder_in(const std::filesystem::path& folder) { return folder / "results"; }

private:
    std::filesystem::path path_of(const ResultKey& key) const;

    std::filesystem::path folder_;
    std::uint64_t made_with_;
};

}  // namespace nezumi
