// Slips in a scenario's own words, found in the text without running it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// Every `s:word(...)` of a scenario's function, with `s` its first parameter, whose word is none of `words` (sorted).
/// Where the function uses the name for something else as well, what comes after is left to its run. `shown` names the
/// text in messages.
std::vector<Error> unknown_words(std::string_view text, const std::string& shown,
                                 const std::vector<std::string_view>& words);

}  // namespace nezumi
