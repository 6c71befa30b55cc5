// A run of a scenario that is shown in a page while it runs.
#pragma once

#include "bindings/cli/run/options.hpp"
#include "bindings/scenario/planned_run.hpp"
#include "bindings/scenario/reporter.hpp"
#include "bindings/scenario/test_plan.hpp"

namespace nezumi::cli {

/// Does the only run of the plan at the pace of the clock, in this process, while a page shows its first world and can
/// change nothing but the pace. It begins when a browser comes, and the page stays until it is closed; without a
/// browser the run is done as fast as possible. Returns the exit status.
int show_run(const TestPlan& plan, TestSessionOptions options, const Web& web, Reporter& reporter);

}  // namespace nezumi::cli
