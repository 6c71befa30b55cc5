// The sub-commands of `nezumi`: each file of this room that is called NAME_command describes one and says what it does.
#pragma once

#include "bindings/cli/command_line.hpp"
#include "bindings/cli/status.hpp"

namespace nezumi::cli {

Command run_command();
Command attach_command();
Command calc_command();
Command types_command();
Command check_command();
Command new_command();
Command test_command();
Command doctor_command();
Command calibrate_command();
Command push_command();
Command marker_command();
Command network_command();
Command completion_command();
Command manual_command();

}  // namespace nezumi::cli
