// Which runs a session makes: files, their scenarios, the points of their sweeps, and a filter.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bindings/scenario/scenario_file.hpp"
#include "bindings/scenario/sweep.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// The scenario files that these paths mean: a file is itself, a folder every `*_test.lua` in it and below, in order of
/// their names; what leads nowhere is a name. Without paths: those in `tests/` and `behaviors/` of the project of the
/// working directory.
Expected<std::vector<std::filesystem::path>> find_scenario_files(const std::vector<std::filesystem::path>& paths);

/// The scenario files of a name, as a person shortens it: "explorer", "explorer_test", "tests/deep/explorer". An error
/// has the nearest name, or the nearest path.
Expected<std::vector<std::filesystem::path>> find_scenarios_called(const std::string& name);

struct PlannedRun {
    std::size_t file = 0;      ///< in the plan
    std::size_t scenario = 0;  ///< in the file
    SweepPoint point{};
    std::string name;    ///< "stops in front of the wall [speed=0.1]"
    bool drawn = false;  ///< at random
};

struct PlannedFile {
    std::filesystem::path path;
    std::string shown;
    std::vector<Scenario> scenarios{};
    std::vector<Error> errors{};  ///< why it could not be read: then it has no scenarios
    bool has_own_stem = true;     ///< no other file of the plan is called so, in another folder
};

struct TestPlan {
    std::vector<PlannedFile> files;
    std::vector<PlannedRun> runs;  ///< in order
};

struct PlanOptions {
    std::vector<std::filesystem::path> paths;
    std::string filter;  ///< part of a run's name; a whole name means no other
    std::uint64_t seed = 0;
    std::vector<std::filesystem::path> installed;
};

/// Reads the files. An error when there is no file or no run at all; what is wrong with a file is in the plan.
Expected<TestPlan> plan_tests(const PlanOptions& options);

/// The name of a run.
std::string name_of_run(const Scenario& scenario, const SweepPoint& point);

/// An argument as a shell takes it.
std::string shell_text(const std::string& argument);

}  // namespace nezumi
