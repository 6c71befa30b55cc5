// nezumi: parses the command line and runs its sub-command.
#include <fmt/format.h>
#include <sys/resource.h>

#include <csignal>
#include <exception>
#include <string>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/standard_files.hpp"
#include "bindings/cli/base/status.hpp"
#include "bindings/cli/program.hpp"

using namespace nezumi;

namespace {

// Returns what to do if the stack limit (`ulimit -s`) is so small that the program could crash; "" if it is large
// enough. A behaviour may use 1 MB of the C stack (watchdog.hpp); its callers and libraries need much less than another
// 1 MB.
std::string stack_problem() {
    constexpr rlim_t least = rlim_t{2} << 20;
    rlimit stack{};
    if (getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= least)
        return "";  // RLIM_INFINITY is the largest value
    return fmt::format("the stack limit is {} kB, at least {} kB are needed: run `ulimit -s 8192` first",
                       stack.rlim_cur >> 10, least >> 10);
}

}  // namespace

int main(int count, char** words) {
    cli::open_missing_standard_files();
    if (const std::string problem = stack_problem(); !problem.empty()) return cli::refuse(problem);
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
