// Results of runs in a folder, a file each: what a session that was cut off, or made only a part, leaves to others.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "bindings/scenario/run_result.hpp"
#include "bindings/scenario/test_plan.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// A part of a plan's runs: every `count`th of them, so that each part has some of what takes long.
struct Shard {
    std::size_t index = 1;  ///< 1 to `count`
    std::size_t count = 1;

    bool has(std::size_t run) const { return run % count == index - 1; }
};

/// What a run was made with, as a number: the version, the seed, and the files that it may read: all of the project's
/// `behaviors/`, and of the project's folders that the scenario files are in (`tests/`) those in Lua, CSV tables, maps
/// and pictures that no session has written. Results that were made with something else are not those of this plan.
std::uint64_t fingerprint(const TestPlan& plan, std::uint64_t seed, const std::string& version,
                          const std::vector<std::filesystem::path>& installed);

/// Whose result it is.
struct ResultKey {
    std::string file;              ///< as the plan shows it
    std::string run;               ///< its name
    std::uint64_t repetition = 0;  ///< of `--repeat`
    bool simplest = false;         ///< not the run itself, but the simplest failure that was found from it
    std::uint64_t seed = 0;        ///< of the run
};

/// A result, and the name and the seed of the run that had it: another one for a simplest failure.
struct KeptResult {
    std::string name;
    RunResult result;
    std::uint64_t seed = 0;
};

/// Files are written whole or not at all, also by several processes at once where each has runs of its own.
class ResultStore {
public:
    /// In `results/` of the folder where failures leave their files.
    ResultStore(std::filesystem::path folder, std::uint64_t made_with)
        : folder_(std::move(folder)), made_with_(made_with) {}

    Expected<void> keep(const ResultKey& key, const KeptResult& result) const;
    /// Nothing when there is none, it is torn, or it was made with something else. The folder of a failure's files is
    /// as it is seen from here.
    std::optional<KeptResult> find(const ResultKey& key) const;
    void forget(const ResultKey& key) const;
    /// Takes the folder of the files away if it is empty, and the one that it is in when `with_parent`.
    void remove_if_empty(bool with_parent) const;

    /// Where the files are.
    static std::filesystem::path folder_in(const std::filesystem::path& folder) { return folder / "results"; }

private:
    std::filesystem::path path_of(const ResultKey& key) const;

    std::filesystem::path folder_;
    std::uint64_t made_with_;
};

}  // namespace nezumi
