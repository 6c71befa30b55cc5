// Slips in a scenario's own words, found in the text without running it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// What is said of a word that `object`, the scenario, does not have: the nearest one, or what stands for it.
std::string unknown_word(std::string_view object, std::string_view word, const std::vector<std::string_view>& words);

/// Every `s:word(...)` of a scenario's function, with `s` its first parameter, whose word is none of `words` (sorted).
/// Where the function uses the name for something else as well, what comes after is left to its run. `shown` names the
/// text in messages.
std::vector<Error> unknown_words(std::string_view text, const std::string& shown,
                                 const std::vector<std::string_view>& words);

}  // namespace nezumi
