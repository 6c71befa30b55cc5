// Parses the arguments of `nezumi new`: names, values, parameters.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::cli {

/// Returns a default in Lua's form: `30`, `0.5`, `true`, `{ 1.0, 0.5 }` are unchanged, other texts are quoted. Fails
/// for a text that looks like a number or a boolean but is not one.
Expected<std::string> default_text(const std::string& given);

/// Returns line_follower for "LineFollower" and "line_follower". An error says which names are possible. `what` is
/// "behaviour", "system" or "robot".
Expected<std::string> new_file_name(std::string_view what, const std::string& given);

/// Checks a new name and adds it to `taken`. Fails if it is already in `taken` or is not valid; keywords of Lua are
/// valid.
Expected<void> take_new_name(std::string_view option, const std::string& name, std::vector<std::string>& taken);

struct NewParameter {
    std::string name;
    std::string initial;  ///< in Lua's form
    std::string options;  ///< "min = 0, max = 1, unit = \"1/s\", doc = \"...\"": the text within its braces
};

/// Parses "gain=0.01,min=0,max=1,step=0.01,choices={...},widget=slider,unit=1/s,doc=...": a name, its default, and
/// options in any order. A comma is part of a value unless one of these names and = follow it.
Expected<NewParameter> read_new_parameter(const std::string& given);

}  // namespace nezumi::cli
