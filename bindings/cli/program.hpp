// The whole command line of `nezumi`, as main() runs it and as whatever describes it reads it.
#pragma once

#include "bindings/cli/shell/command_line.hpp"

namespace nezumi::cli {

/// With values of its own for all options: one is made for each time that it is parsed.
SubCommand program();

}  // namespace nezumi::cli
