// How files of a run are called, and the folder that a failing run leaves its files in.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi {

/// What a run's folder or file is called, from the scenario's file and the run: "stop_test-drives-speed=0.1". Letters
/// of any language, digits and . = _ - are kept. Where other signs were, where the name was cut, or where `file` is not
/// the only one of its stem
/// (`alone`), something follows that tells the run from all others. Never empty, never hidden.
std::string run_file_name(const std::filesystem::path& file, std::string_view run, bool alone);

/// Makes the folder, or empties it of what an earlier failure left. Returns its path.
Expected<std::string> make_failure_folder(const std::filesystem::path& folder);

}  // namespace nezumi
