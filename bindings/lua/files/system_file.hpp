// Reads system files as data.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/live/script_host.hpp"
#include "engine/project/project.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// Reads a system file and every file that it names, except scripts, which are found but not read. Errors have file
/// and line. Checks that need the components themselves (ports, parameters, overlaps) are done by `build_system`.
Expected<SystemSpec> read_system_file(const std::filesystem::path& path, const Project& project,
                                      const SystemFileOptions& options = {});

/// Reads a system file from a text; `shown` is the file's name in errors, and names are first searched in its folder.
Expected<SystemSpec> read_system_text(std::string_view text, const std::string& shown, const Project& project,
                                      const SystemFileOptions& options = {});

/// All mistakes of a system file that can be found without building the system; empty if it can be read. For editors:
/// one error for each unknown global, otherwise the first error.
std::vector<Error> check_system_text(std::string_view text, const std::string& shown, const Project& project,
                                     const SystemFileOptions& options = {});

}  // namespace nezumi
