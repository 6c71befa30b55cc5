// `nezumi types`: the message types.
#include <CLI/CLI.hpp>

#include "bindings/cli/commands.hpp"

namespace nezumi::cli {

void add_types_command(CLI::App& app, int& status) {
    CLI::App* command = app.add_subcommand("types", "Show the message types with their fields, units and limits");
    command->callback([&status] { status = kDone; });
}

}  // namespace nezumi::cli
