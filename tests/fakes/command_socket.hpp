// A test's line to a fake robot: a command a line, its answer, and a line with a dot.
#pragma once

#include <functional>
#include <string>

namespace nezumi::fakes {

/// Listens at a Unix socket until the process ends, with a thread for itself and one for each client. `answer` gets
/// each line without its end, by several threads at once. False when there can be no such socket.
bool serve_commands(const std::string& path, std::function<std::string(const std::string& line)> answer);

}  // namespace nezumi::fakes
