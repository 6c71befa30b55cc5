// How `nezumi` ends: scripts rely on it.
#pragma once

namespace nezumi::cli {

enum Status : int {
    exit_done = 0,
    exit_failed = 1,         ///< a scenario failed, a file has something wrong with it
    exit_could_not_run = 2,  ///< bad input, a missing file, no permission: one plain line has said which
};

}  // namespace nezumi::cli
