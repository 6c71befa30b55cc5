// nezumi: parses the command line and runs the sub-command that it names.
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
    std::signal(SIGXFSZ, SIG_IGN);  // writing beyond a file's limit is an error like others, also to whoever is started
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
