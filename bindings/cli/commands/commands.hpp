// The sub-commands of `nezumi`: each one is described and implemented in a file of this folder.
#pragma once

#include "bindings/cli/base/status.hpp"
#include "bindings/cli/shell/command_line.hpp"

namespace nezumi::cli {

SubCommand run_command();
SubCommand attach_command();
SubCommand calc_command();
SubCommand class_command();
SubCommand confined_command();
SubCommand types_command();
SubCommand check_command();
SubCommand list_command();
SubCommand new_command();
SubCommand test_command();
SubCommand doctor_command();
SubCommand calibrate_command();
SubCommand push_command();
SubCommand receive_command();
SubCommand marker_command();
SubCommand maze_command();
SubCommand share_command();
SubCommand mms_command();
SubCommand mcp_command();
SubCommand environment_command();

SubCommand network_command();
SubCommand rtc_command();
SubCommand open_command();
SubCommand compare_command();
SubCommand judge_command();
/// These two describe the whole program: `program` returns its description.
SubCommand completion_command(SubCommand (*program)());
SubCommand manual_command(SubCommand (*program)());

}  // namespace nezumi::cli
