// Methods that a scenario does not have, found in the text without running it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// What is said of a method that `object`, the scenario, does not have: the nearest one, or what stands for it.
std::string unknown_method(std::string_view object, std::string_view name,
                           const std::vector<std::string_view>& methods);

/// Every `s:name(...)` of a scenario's function, with `s` its first parameter, whose name is none of `methods`
/// (sorted). Where the function uses the name for something else as well, what comes after is left to its run. `shown`
/// names the text in messages.
std::vector<Error> unknown_methods(std::string_view text, const std::string& shown,
                                   const std::vector<std::string_view>& methods);

}  // namespace nezumi
