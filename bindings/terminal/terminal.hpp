// The prompt on a terminal: a client of the console's protocol, the same in `nezumi run` and `nezumi attach`.
#pragma once

#include <filesystem>
#include <string>

#include "bindings/console/client.hpp"
#include "engine/base/descriptor.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

struct TerminalOptions {
    int input = 0;                  ///< file descriptor of a terminal, which nothing else may read meanwhile
    int output = 1;                 ///< the same terminal
    std::string greeting;           ///< the first line; "" for none
    std::filesystem::path history;  ///< the history file; empty: none
    bool attached = false;          ///< the system runs in another process: Ctrl-Z may suspend this one
};

/// The reason why the prompt ended.
enum class PromptEnd {
    left,   ///< Ctrl-D, or the terminal is closed
    ended,  ///< the system has ended
};

/// Reads inputs, runs them and shows output, until the user leaves. Restores the terminal's settings. Fails if it is
/// not a terminal.
Expected<PromptEnd> run_prompt(ConsoleClient& client, const TerminalOptions& options);

}  // namespace nezumi
