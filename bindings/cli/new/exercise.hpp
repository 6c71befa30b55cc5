// A new exercise for a class as files.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/new/files.hpp"

namespace nezumi::cli {

/// The files of an exercise with this name; paths are relative to its folder.
std::vector<NewFile> exercise_files(const std::string& name);

}  // namespace nezumi::cli
