// Checks a command line's words and files before a command runs; the same for all commands.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/shell/command_line.hpp"

namespace nezumi::cli {

/// Returns which option of `words`, the words after the command's name, is followed by another option instead of its
/// value; "" if none. "--record=--odd" is a value.
std::string missing_value(const SubCommand& command, const std::vector<std::string>& words);

/// Returns which option's output file would overwrite a script, or a file of another option; "" if none. For options
/// with values.
std::string lost_file(const SubCommand& command);

}  // namespace nezumi::cli
