// Exit statuses of `nezumi`; scripts rely on them.
#pragma once

namespace nezumi::cli {

enum Status : int {
    exit_done = 0,
    exit_failed = 1,         ///< a scenario failed, or a file has an error
    exit_could_not_run = 2,  ///< bad input, a missing file, no permission: one line on standard error gives the reason
};

}  // namespace nezumi::cli
