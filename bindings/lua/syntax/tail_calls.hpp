// Finds tail calls, after which the calling function is no longer on the stack.
#pragma once

#include <string_view>
#include <vector>

namespace nezumi {

/// The lines of `return f(...)` in the function of a file from line `first` to line `last`, in order, without inner
/// functions.
std::vector<int> tail_calls_of(std::string_view text, int first, int last);

}  // namespace nezumi
