// Reads system files: what there is and how it is wired, as data.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/live/script_host.hpp"
#include "engine/project/project.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// Reads a system file and every file that it names, except scripts, which are only found. Errors say file and line.
/// What needs the components themselves (ports, parameters, overlaps) is left to `build_system`.
Expected<SystemSpec> read_system_file(const std::filesystem::path& path, const Project& project,
                                      const SystemFileOptions& options = {});

/// The same from text; `shown` is the file's name in errors, and its folder is where names are looked up first.
Expected<SystemSpec> read_system_text(std::string_view text, const std::string& shown, const Project& project,
                                      const SystemFileOptions& options = {});

/// All that is wrong with a system file, as far as it is known without building the system; empty when it can be read.
/// For editors: every unknown global is one error, of anything else the first.
std::vector<Error> check_system_text(std::string_view text, const std::string& shown, const Project& project);

}  // namespace nezumi
