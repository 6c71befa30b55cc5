// Whether the system gives the program a stack that it can work with.
#pragma once

#include <string>

namespace nezumi::cli {

/// What to do about a limit of the stack (`ulimit -s`) under which code would end by a signal; empty: it is large
/// enough.
std::string stack_problem();

}  // namespace nezumi::cli
