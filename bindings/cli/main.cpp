// nezumi: parses the command line and runs the sub-command that it names.
#include <exception>
#include <string>

#include "bindings/cli/commands.hpp"
#include "bindings/cli/environment.hpp"
#include "bindings/cli/standard_files.hpp"

using namespace nezumi;

int main(int count, char** words) {
    cli::open_missing_standard_files();
    int status = cli::kCouldNotRun;
    std::string problem;
    try {
        const cli::Command program{
            .name = "nezumi",
            .help = "nezumi runs what small robots do: Lua behaviours, in simulation and on the robots",
            .commands = {cli::run_command(), cli::attach_command(), cli::calc_command(), cli::types_command(),
                         cli::check_command(), cli::new_command(), cli::test_command(), cli::doctor_command(),
                         cli::calibrate_command(), cli::push_command()},
            .version = "nezumi " NEZUMI_VERSION};
        status = cli::run_command_line(program, {words + 1, words + count});
    } catch (const std::exception& error) {
        problem = error.what();
    }
    if (const std::string lost = cli::lost_output(); !lost.empty()) problem = lost;
    return problem.empty() ? status : cli::refuse(problem);
}
