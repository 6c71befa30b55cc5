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

/// Every `s:name(...)` whose name is none of `methods` (sorted), in the order of the text. `s` is the first parameter
/// of a scenario's function, given as it is or by its name; a parameter of a function of the text that is called with
/// `s`; or a local that begins as `s`. What the text does not say so plainly is left to its run. `shown` names the text
/// in messages.
std::vector<Error> unknown_methods(std::string_view text, const std::string& shown,
                                   const std::vector<std::string_view>& methods);

}  // namespace nezumi
