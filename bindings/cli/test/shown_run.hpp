// A run of a scenario that is shown in a page while it runs.
#pragma once

#include "bindings/cli/run/options.hpp"
#include "bindings/scenario/planned_run.hpp"
#include "bindings/scenario/reporter.hpp"
#include "bindings/scenario/test_plan.hpp"

namespace nezumi::cli {

/// Makes the only run of the plan in real time, in this process, while a page shows its first world. The page can
/// change only the speed. The run begins when a browser opens the page, and the page is served until the browser closes
/// it. Without a browser the run is made as fast as possible. Returns the exit status.
int show_run(const TestPlan& plan, TestSessionOptions options, const Web& web, Reporter& reporter);

}  // namespace nezumi::cli
