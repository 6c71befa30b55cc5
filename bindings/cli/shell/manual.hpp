// The manual pages, written from the description of the command line that --help comes from.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/shell/command_line.hpp"

namespace nezumi::cli {

struct ManualPage {
    std::string name;  ///< "nezumi-run.1"
    std::string text;  ///< for man(7)
};

/// One of the program and one of each of its commands; what is below a command has a section there.
std::vector<ManualPage> manual_pages(const SubCommand& program);

}  // namespace nezumi::cli
