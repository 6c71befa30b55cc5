// Checks a command line's words and files before a command runs; the same for all commands.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/shell/command_line.hpp"

namespace nezumi::cli {

/// Returns an error if an option in `words`, the words after the command's name, is followed by another option instead
/// of its value; "" if there is none. "--record=--odd" is a value.
std::string missing_value(const SubCommand& command, const std::vector<std::string>& words);

/// Returns an error if the output file of an option would overwrite a script, or the file of another option; "" if
/// there is none. Call this after parsing.
std::string lost_file(const SubCommand& command);

}  // namespace nezumi::cli
