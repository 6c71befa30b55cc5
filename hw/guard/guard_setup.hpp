// The setup of processes that outlive the engine in order to stop motors or devices.
#pragma once

#include <cstddef>

namespace nezumi::hw {

/// The place of a process's command line in its memory.
struct ProcessWords {
    char* begin = nullptr;  ///< null: not found
    std::size_t size = 0;

    static ProcessWords of_this();
};

/// Makes the calling process, which was just forked, independent of the engine: gives it another session, name and
/// signal handling, and closes all files except `socket` and `lease`. Returns a file that becomes readable when the
/// thread that forked the process has died. Allocates nothing.
int become_guard(int socket, int lease, const ProcessWords& words);

}  // namespace nezumi::hw
