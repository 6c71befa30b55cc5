// Finds unknown methods of a scenario in the text without running it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// The message about an unknown method of `object`, the scenario: the nearest method, or the replacement.
std::string unknown_method(std::string_view object, std::string_view name,
                           const std::vector<std::string_view>& methods);

/// Every call `s:name(...)` with a name that is not in `methods` (sorted), in the order of the text. `s` is the first
/// parameter of a scenario's function (given directly or by its name), a parameter of a function of the text that is
/// called with `s`, or a local that is initialised with `s`. Other ways to get the scenario are checked only at run
/// time. `shown` names the text in messages.
std::vector<Error> unknown_methods(std::string_view text, const std::string& shown,
                                   const std::vector<std::string_view>& methods);

/// Whether the call `scenario(...)` of this line calls `s:any`, or a method of this name of anything else.
bool calls_any(std::string_view text, int line);

}  // namespace nezumi
