// One run of a system, from the options to the exit status.
#pragma once

#include "bindings/cli/run/options.hpp"

namespace nezumi::cli {

/// Runs a system until its end or Ctrl-C. Returns the exit status. Errors are printed to standard error.
int run_system(RunOptions options);

}  // namespace nezumi::cli
