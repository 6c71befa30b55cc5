// Calls after which a function is gone.
#pragma once

#include <string_view>
#include <vector>

namespace nezumi {

/// The lines of `return f(...)` in the function of a file that begins in line `first` and ends in line `last`, in
/// order; none of functions within it.
std::vector<int> tail_calls_of(std::string_view text, int first, int last);

}  // namespace nezumi
