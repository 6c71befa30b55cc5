// What a person writes on the command line of `nezumi new`: names, values, parameters.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::cli {

/// A default as Lua writes it: `30`, `0.5`, `true`, `{ 1.0, 0.5 }` stay, any other text is quoted. An error when it
/// looks like a number or a truth value and is none.
Expected<std::string> default_text(const std::string& given);

/// "LineFollower" and "line_follower" are both line_follower; an error says which names there can be. `what` it names
/// is "behaviour", "system" or "robot".
Expected<std::string> new_file_name(std::string_view what, const std::string& given);

/// Of a name that is taken (true), or is no name, an error; else it is taken from now on.
Expected<void> take_new_name(std::string_view option, const std::string& name, std::vector<std::string>& taken);

struct NewParameter {
    std::string name;
    std::string initial;  ///< as Lua writes it
    std::string options;  ///< "min = 0, max = 1, unit = \"1/s\", doc = \"...\"": what stands in its braces
};

/// "gain=0.01,min=0,max=1,step=0.01,choices={...},widget=slider,unit=1/s,doc=...": a name, its default, and in any
/// order what is known of it. A comma belongs to a value unless one of these names and = follow it.
Expected<NewParameter> read_new_parameter(const std::string& given);

}  // namespace nezumi::cli
