// nezumi: parses the command line and runs its sub-command.
#include <csignal>
#include <exception>
#include <string>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/stack_limit.hpp"
#include "bindings/cli/base/standard_files.hpp"
#include "bindings/cli/base/status.hpp"
#include "bindings/cli/program.hpp"

using namespace nezumi;

int main(int count, char** words) {
    cli::open_missing_standard_files();
    if (const std::string problem = cli::stack_problem(); !problem.empty()) return cli::refuse(problem);
    std::signal(SIGXFSZ, SIG_IGN);  // exceeding a file size limit is an ordinary error, also in child processes
    int status = cli::exit_could_not_run;
    std::string problem;
    try {
        status = cli::run_command_line(cli::program(), {words + 1, words + count});
    } catch (const std::exception& error) {
        problem = error.what();
    }
    if (const std::string lost = cli::lost_output(); !lost.empty()) problem = lost;
    return problem.empty() ? status : cli::refuse(problem);
}
