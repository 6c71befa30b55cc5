// The sub-commands of `nezumi`: each file of this room adds one, and says there what it does.
#pragma once

#include <CLI/App.hpp>

namespace nezumi::cli {

/// How `nezumi` ends: scripts rely on it.
enum Status : int {
    kDone = 0,
    kFailed = 1,       ///< a scenario failed, a file has something wrong with it
    kCouldNotRun = 2,  ///< bad input, a missing file, no permission: one plain line has said which
};

/// Each adds its sub-command, which sets `status` when it is run.
void add_run_command(CLI::App& app, int& status);
void add_attach_command(CLI::App& app, int& status);
void add_types_command(CLI::App& app, int& status);
void add_check_command(CLI::App& app, int& status);
void add_new_command(CLI::App& app, int& status);
void add_test_command(CLI::App& app, int& status);
void add_calc_command(CLI::App& app, int& status);

}  // namespace nezumi::cli
