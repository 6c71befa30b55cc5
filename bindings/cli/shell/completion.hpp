// Scripts that let shells complete `nezumi`'s command line, written from its description.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/shell/command_line.hpp"

namespace nezumi::cli {

/// What can stand where an option's value does, as far as its description says it.
struct ValueWords {
    bool files = false;                ///< names of files or folders
    std::vector<std::string> words{};  ///< these words
};
ValueWords value_words(const Option& option);

/// The shells that there are scripts for: "bash", "zsh", "fish".
const std::vector<std::string_view>& completed_shells();

/// The script for one of them: commands, options, words that values can have, files elsewhere.
std::string completion_script(const SubCommand& program, std::string_view shell);

}  // namespace nezumi::cli
