// The whole command line of `nezumi`, used by main(), the manual and the shell completion.
#pragma once

#include "bindings/cli/shell/command_line.hpp"

namespace nezumi::cli {

/// Has its own values of all options, so a new one is made for each parsing.
SubCommand program();

}  // namespace nezumi::cli
