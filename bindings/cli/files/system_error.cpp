// For an unknown global of another kind of file, names that kind.
#include "bindings/cli/files/system_error.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "bindings/lua/script/script_globals.hpp"

namespace nezumi::cli {

Error explain_system_error(Error error) {
    constexpr std::string_view begin = "unknown global '";
    if (!error.message.starts_with(begin)) return error;
    const std::string name = error.message.substr(begin.size(), error.message.find('\'', begin.size()) - begin.size());
    const auto& globals = script_globals();
    if (name == "scenario") {
        error.message += ": it is for scenarios; try `nezumi test`";
    } else if (name == "robot_model") {
        error.message += ": it is for robot files; in a system file write `robot NAME { model = ... }`";
    } else if (name.starts_with("on_") || std::find(globals.begin(), globals.end(), name) != globals.end()) {
        error.message += ": it is for behaviours; in a system file write `behavior NAME { script = ... }`";
    }
    return error;
}

}  // namespace nezumi::cli
