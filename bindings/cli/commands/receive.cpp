// `nezumi receive`: the robot's side of `nezumi push`.
#include <unistd.h>

#include <csignal>
#include <memory>
#include <string>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/push/connection.hpp"
#include "bindings/push/interrupted.hpp"
#include "bindings/push/receive.hpp"

namespace nezumi::cli {

SubCommand receive_command() {
    auto finished = std::make_shared<std::string>();
    return {
        .name = "receive",
        .help = "Receive the project that `nezumi push` on another computer sends by ssh",
        .options = {{"--finish", finished.get(),
                     "instead: finish an interrupted push to the project of this file, as `nezumi run` does before it "
                     "reads the project",
                     "FILE"}},
        .run = [finished]() -> int {
            if (!finished->empty()) {
                const auto done = push::finish_interrupted_push(*finished);
                return done ? exit_done : refuse(done.error());
            }
            std::signal(SIGPIPE, SIG_IGN);
            return push::receive_project({STDIN_FILENO, STDOUT_FILENO, push::longest_silence}) ? exit_done
                                                                                               : exit_could_not_run;
        },
        .footer = "Exit status: 0 done, 2 not done."};
}

}  // namespace nezumi::cli
