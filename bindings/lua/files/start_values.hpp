// Parameter values that replace those of the system file when a system starts.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/live/script_host.hpp"
#include "engine/project/project.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// Puts `values` into `spec`. `project` finds the files that are named. Values that a parameter refuses are reported
/// later by `build_system`, which names the option or the line of the file. `words`: as in `SystemFileOptions`.
Expected<void> apply(const StartValues& values, SystemSpec& spec, const Project& project, const PeerWords& words = {});

/// The value of a text of the command line: 30, 0.3, true, "text", { 1, 2 } as in Lua; any other word is a text.
/// `shown` is the option in errors.
Expected<Value> read_option_value(const std::string& text, const Project& project, const std::string& shown);

/// Whether "n=10" sets an argument of a system file: there is no dot before the =.
bool sets_argument(std::string_view text);

}  // namespace nezumi
