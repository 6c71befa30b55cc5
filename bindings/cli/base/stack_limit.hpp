// Checks that the program's stack is large enough.
#pragma once

#include <string>

namespace nezumi::cli {

/// Returns what to do about a stack limit (`ulimit -s`) that is so small that the program would crash; empty if it is
/// large enough.
std::string stack_problem();

}  // namespace nezumi::cli
