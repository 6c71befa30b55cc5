// The sub-commands of `nezumi`: each file of this room that is called NAME_command describes one and says what it does.
#pragma once

#include "bindings/cli/command_line.hpp"
#include "bindings/cli/status.hpp"

namespace nezumi::cli {

SubCommand run_command();
SubCommand attach_command();
SubCommand calc_command();
SubCommand types_command();
SubCommand check_command();
SubCommand new_command();
SubCommand test_command();
SubCommand doctor_command();
SubCommand calibrate_command();
SubCommand push_command();
SubCommand receive_command();
SubCommand marker_command();
SubCommand network_command();
SubCommand completion_command();
SubCommand manual_command();

}  // namespace nezumi::cli
