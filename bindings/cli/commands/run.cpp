// `nezumi run`: runs a system file until its end or Ctrl-C.
#include <memory>
#include <utility>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/run/options.hpp"
#include "bindings/cli/run/run.hpp"

namespace nezumi::cli {

SubCommand run_command() {
    auto words = std::make_shared<RunWords>();
    return {.name = "run",
            .help = "Run a system file: simulate it, and reload scripts when they are saved",
            .options = run_options(*words),
            .run =
                [words] {
                    auto options = read_run_options(*words);
                    return options ? run_system(std::move(*options)) : refuse(options.error());
                },
            .footer =
                "Ctrl-C ends a run normally: behaviours are deactivated, robots stop, files are complete. Outputs that "
                "accept no data are given up after 2 s, or immediately after a second Ctrl-C.\n"
                "Exit status: 0 the run ended normally; 1 it ended, but a component was in ERROR, a command of --batch "
                "failed or was cut off, or the last output was lost; 2 it could not be run, or its files could not be "
                "written."};
}

}  // namespace nezumi::cli
