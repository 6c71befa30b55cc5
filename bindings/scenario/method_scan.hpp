// Finds unknown methods of a scenario in the text without running it.
#pragma once

#include <set>
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

/// The scenarios that call `s:any`, or a method `any` of any other object.
struct DrawingScenarios {
    bool all = false;     ///< a function outside of all scenarios calls it
    std::set<int> lines;  ///< of the calls `scenario(...)` that contain such a call

    bool contain(int line) const { return all || lines.count(line) != 0; }
};
DrawingScenarios find_drawing_scenarios(std::string_view text);

}  // namespace nezumi
