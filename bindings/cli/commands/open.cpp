// `nezumi open`: opens a past run, paused at its end; each of its moments can be shown.
#include <memory>
#include <utility>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/run/options.hpp"
#include "bindings/cli/run/run.hpp"

namespace nezumi::cli {

SubCommand open_command() {
    auto words = std::make_shared<RunWords>();
    return {.name = "open",
            .help = "Open a past run in the page and the console, paused at its end",
            .options = open_options(*words),
            .run =
                [words] {
                    auto options = read_run_options(*words);
                    return options ? run_system(std::move(*options)) : refuse(options.error());
                },
            .footer =
                "The run is repeated from its journal, and no other file is read. rewind(5), seek(12.3) and the page's "
                "time line go to\nany moment of it; resume() repeats the rest of the run, and a change starts a "
                "branch. The journal stays as it is."};
}

}  // namespace nezumi::cli
