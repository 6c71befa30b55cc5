// The manual pages, derived from the description of the command line, like --help.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/shell/command_line.hpp"

namespace nezumi::cli {

struct ManualPage {
    std::string name;  ///< "nezumi-run.1"
    std::string text;  ///< for man(7)
};

/// One page for the program and one for each command; sub-commands are sections.
std::vector<ManualPage> manual_pages(const SubCommand& program);

}  // namespace nezumi::cli
