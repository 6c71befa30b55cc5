// `nezumi test --watch`: runs what a save touches.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "bindings/scenario/planned_run.hpp"
#include "bindings/scenario/reporter.hpp"
#include "bindings/scenario/test_plan.hpp"

namespace nezumi::cli {

/// Makes all runs, and after each save those that have read a saved file: first those that failed last. New scenarios
/// run too, also those of new files that `paths` mean. Returns the exit status of the last session when a signal ends
/// it.
int watch_tests(const std::vector<std::filesystem::path>& paths, const std::function<Expected<TestPlan>()>& make_plan,
                const TestSessionOptions& options, const std::function<std::unique_ptr<Reporter>()>& make_reporter);

}  // namespace nezumi::cli
