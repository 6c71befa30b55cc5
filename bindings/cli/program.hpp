// The whole command line of `nezumi`, used by main(), the manual and the shell completion.
#pragma once

#include "bindings/cli/shell/command_line.hpp"

namespace nezumi::cli {

/// Each call makes a new description: it holds the option values of one parsing.
SubCommand program();

}  // namespace nezumi::cli
