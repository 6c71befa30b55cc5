// A new project as files: a first behaviour with its system and scenario, and files for editors.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/new/files.hpp"

namespace nezumi::cli {

/// The files of a project with this name; paths are relative to its folder.
std::vector<NewFile> project_files(const std::string& name);

}  // namespace nezumi::cli
