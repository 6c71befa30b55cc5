// The names of files of a run, and the folder for the files of a failed run.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi {

/// The name of a run's folder or file, from the scenario's file and the run: "stop_test-drives-speed=0.1". Keeps
/// letters of all languages, digits and . = _ -. A unique part is added if characters were replaced, if the name was
/// cut, or if another file has the same stem (`alone` is false). Never empty, never hidden.
std::string run_file_name(const std::filesystem::path& file, std::string_view run, bool alone);

/// Creates the folder, or removes the files of an earlier failure from it. Returns its path.
Expected<std::string> make_failure_folder(const std::filesystem::path& folder);

}  // namespace nezumi
