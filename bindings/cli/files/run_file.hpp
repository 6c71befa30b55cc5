// Files that contain a run: a journal, or a recording with one.
#pragma once

#include <filesystem>
#include <string>

#include "engine/base/error.hpp"

namespace nezumi::cli {

/// The journal in this file. The error says what the file lacks.
Expected<std::string> read_run(const std::filesystem::path& file);

}  // namespace nezumi::cli
