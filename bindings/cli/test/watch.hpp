// `nezumi test --watch`: runs the scenarios that a saved file affects.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "bindings/scenario/planned_run.hpp"
#include "bindings/scenario/reporter.hpp"
#include "bindings/scenario/test_plan.hpp"

namespace nezumi::cli {

/// Makes all runs. After each save, repeats the runs that have read a saved file, failed ones first. New scenarios run
/// too, also those of new files below `paths`. When a signal ends the watching, returns the exit status of the last
/// session.
int watch_tests(const std::vector<std::filesystem::path>& paths, const std::function<Expected<TestPlan>()>& make_plan,
                const TestSessionOptions& options, const std::function<std::unique_ptr<Reporter>()>& make_reporter);

}  // namespace nezumi::cli
