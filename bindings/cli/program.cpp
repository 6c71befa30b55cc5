// Joins the sub-commands to the program.
#include "bindings/cli/program.hpp"

#include <fmt/format.h>

#include "bindings/cli/base/version.hpp"
#include "bindings/cli/commands/commands.hpp"

namespace nezumi::cli {

SubCommand program() {
    return {.name = "nezumi",
            .help = "nezumi runs what small robots do: Lua behaviours, in simulation and on the robots",
            .commands = {run_command(),          attach_command(),
                         open_command(),         compare_command(),
                         judge_command(),        calc_command(),
                         types_command(),        check_command(),
                         list_command(),         new_command(),
                         test_command(),         doctor_command(),
                         calibrate_command(),    push_command(),
                         receive_command(),      marker_command(),
                         maze_command(),         share_command(),
                         mms_command(),          class_command(),
                         confined_command(),     mcp_command(),
                         environment_command(),  network_command(),
                         rtc_command(),          completion_command(program),
                         manual_command(program)},
            .version = fmt::format("nezumi {}", version())};
}

}  // namespace nezumi::cli
