// Scripts for completion in shells, derived from the description of the command line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/shell/command_line.hpp"

namespace nezumi::cli {

/// The possible values of an option, as far as its description shows them.
struct ValueWords {
    bool files = false;                ///< names of files or folders
    std::vector<std::string> words{};  ///< these words
};
ValueWords value_words(const Option& option);

/// The supported shells: "bash", "zsh", "fish".
const std::vector<std::string_view>& completed_shells();

/// The script for a shell: completes commands, options and known values, otherwise files.
std::string completion_script(const SubCommand& program, std::string_view shell);

}  // namespace nezumi::cli
