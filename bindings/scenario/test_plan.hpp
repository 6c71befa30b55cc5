// The runs of a session: files, their scenarios, the points of their sweeps, and a filter.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bindings/scenario/scenario_file.hpp"
#include "bindings/scenario/sweep.hpp"
#include "engine/base/error.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// The scenario files for these paths. A folder stands for every `*_test.lua` in it and below, sorted by name; a path
/// that does not exist is a name. Without paths: the files in `tests/` and `behaviors/` of the project of the working
/// directory.
Expected<std::vector<std::filesystem::path>> find_scenario_files(const std::vector<std::filesystem::path>& paths);

/// The scenario files for a short name: "explorer", "explorer_test", "tests/deep/explorer". The error has the nearest
/// name, or the nearest path.
Expected<std::vector<std::filesystem::path>> find_scenarios_called(const std::string& name);

/// The seeds of the option --seeds, from the first to the last.
struct SeedRange {
    std::uint64_t first = 0, last = 0;
};

/// One of several runs with the same values.
struct Repetition {
    std::string name;  ///< what follows in the name of the run: " #3", " seed 17"; "" of the only one
    std::optional<std::uint64_t> seed{};  ///< from --seeds; nothing: from the session's seed and the run's name
};

struct PlannedRun {
    std::size_t file = 0;      ///< index in the plan
    std::size_t scenario = 0;  ///< index in the file
    SweepPoint point{};
    std::string name;       ///< "stops in front of the wall [speed=0.1]", with its repetition
    bool drawn = false;     ///< its values are random draws
    bool searched = false;  ///< a search chooses its values: the name is only a number, until it has been made
    Repetition repetition{};
    std::uint64_t seed = 0;  ///< for all random draws of the run: below 2^53, unless the user gave it
};

struct PlannedFile {
    std::filesystem::path path;
    std::string shown;
    std::vector<Scenario> scenarios{};
    std::vector<Error> errors{};            ///< why it could not be read; then it has no scenarios
    std::vector<std::string> looked_for{};  ///< paths of modules that it read or looked for
    bool has_own_stem = true;               ///< no other file of the plan has this name in another folder
};

struct TestPlan {
    std::vector<PlannedFile> files;
    std::vector<PlannedRun> runs;  ///< in order
    std::uint64_t seed = 0;        ///< of the session
};

struct PlanOptions {
    std::vector<std::filesystem::path> paths;
    std::string filter;  ///< part of a run's name; the whole name of a run selects only this run
    std::uint64_t seed = 0;
    std::vector<std::filesystem::path> installed;
    PeerWords peer_words{};            ///< as in `LiveOptions`
    std::optional<SeedRange> seeds{};  ///< each combination is run with each, instead of the scenario's seeds
    std::size_t search = 0;            ///< number of runs that a search chooses for a scenario with a range or `s:any`
    std::string paired;                ///< for all scenarios whose sweep has a list of this name; "": their own option
};

/// Reads the files. An error if there is no file or no run; mistakes of a file are in the plan.
Expected<TestPlan> plan_tests(const PlanOptions& options);

/// The run with these values, with its name and its seed.
PlannedRun planned_run(const TestPlan& plan, std::size_t file, std::size_t scenario, SweepPoint point,
                       const Repetition& repetition);

/// An argument in the syntax of a shell.
std::string shell_text(const std::string& argument);

}  // namespace nezumi
