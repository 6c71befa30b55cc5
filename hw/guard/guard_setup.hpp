// The setup of the processes that outlive the engine in order to stop something.
#pragma once

#include <cstddef>

namespace nezumi::hw {

/// The command line of a process, in its memory.
struct ProcessWords {
    char* begin = nullptr;  ///< null: not found
    std::size_t size = 0;

    static ProcessWords of_this();
};

/// Makes the calling process, just forked, independent of the engine: of its session, signals, name, and of all its
/// files but these two. Returns a file that is readable when the thread that forked it has died. Allocates nothing.
int become_guard(int socket, int lease, const ProcessWords& words);

}  // namespace nezumi::hw
