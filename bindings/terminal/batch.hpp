// Commands from a file or a pipe instead of a terminal.
#pragma once

#include <cstdio>
#include <optional>
#include <string>

#include "bindings/console/client.hpp"

namespace nezumi {

/// Where commands are read from, and where output is written.
struct BatchFiles {
    bool own = false;      ///< the system runs for these commands: that it ends, by `quit()`, is no failure of the next
    int input = 0;         ///< commands; an input of several lines is taken whole
    FILE* out = stdout;    ///< results, and what commands print and watch
    FILE* error = stderr;  ///< errors, with the line that they are from, and the log
};

/// How commands ended.
struct BatchEnd {
    bool well = true;  ///< all that were run succeeded
    int unfinished =
        0;  ///< line of the first one that was cut off, or never begun, because the system had ended; 0: none
};

/// Runs one command after the other until there are no more or the system ends. An error costs its command and no more.
BatchEnd run_batch(ConsoleClient& client, const BatchFiles& files);

/// Runs one command, and interrupts it when there is no answer after `timeout` [s]. Returns whether it succeeded,
/// and all of what it shows got through.
bool run_text(ConsoleClient& client, const std::string& text, const BatchFiles& files,
              std::optional<double> timeout = {});

}  // namespace nezumi
