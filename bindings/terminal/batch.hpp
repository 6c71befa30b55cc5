// Runs commands from a file or a pipe instead of a terminal.
#pragma once

#include <cstdio>
#include <optional>
#include <string>

#include "bindings/console/client.hpp"

namespace nezumi {

/// Where commands are read from, and where output is written.
struct BatchFiles {
    bool own = false;      ///< the system runs only for these commands, so its end by `quit()` is not an error
    int input = 0;         ///< file descriptor of the commands; an input of several lines is one command
    FILE* out = stdout;    ///< results, and printed and watched values
    FILE* error = stderr;  ///< errors with their lines, and the log
};

/// How a batch of commands ended.
struct BatchEnd {
    bool well = true;    ///< all commands succeeded
    int unfinished = 0;  ///< line of the first command that did not finish because the system ended; 0: none
};

/// Runs one command after the other until there are no more or the system ends. After an error the next command is run.
BatchEnd run_batch(ConsoleClient& client, const BatchFiles& files);

/// Runs one command, and interrupts it if there is no answer after `timeout` [s]. Returns true if it succeeded and no
/// output was lost.
bool run_text(ConsoleClient& client, const std::string& text, const BatchFiles& files,
              std::optional<double> timeout = {});

}  // namespace nezumi
