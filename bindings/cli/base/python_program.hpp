// Programs of nezumi that run in Debian's Python.
#pragma once

#include <string>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::cli {

/// The installed file with this name, such as "bindings/calc/link.py"; an error if it is not installed.
Expected<std::string> python_file(const std::string& name);

/// Replaces this process by Debian's Python, which runs `file` with the arguments `words`. Returns only if Python can't
/// be started: errno is the reason. Python writes no files beside the program and ignores the user's environment.
void become_python(const std::string& file, const std::vector<std::string>& words);

}  // namespace nezumi::cli
