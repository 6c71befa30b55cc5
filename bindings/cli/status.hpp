// How `nezumi` ends: scripts rely on it.
#pragma once

namespace nezumi::cli {

enum Status : int {
    kDone = 0,
    kFailed = 1,       ///< a scenario failed, a file has something wrong with it
    kCouldNotRun = 2,  ///< bad input, a missing file, no permission: one plain line has said which
};

}  // namespace nezumi::cli
