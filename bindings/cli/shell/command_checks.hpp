// What is wrong with a command line's words and files, before anything runs; the same for all commands.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/shell/command_line.hpp"

namespace nezumi::cli {

/// Says which option of `words`, those behind the command's name, has another option where its value should be; "" when
/// none has. "--record=--odd" is a value.
std::string missing_value(const SubCommand& command, const std::vector<std::string>& words);

/// Says which option names a result's file that would be written over a script, or over what another option writes or
/// reads; "" when none does. For options that have their values.
std::string lost_file(const SubCommand& command);

}  // namespace nezumi::cli
