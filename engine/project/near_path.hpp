// Finds the nearest existing path for a path that does not exist.
#pragma once

#include <filesystem>
#include <string>

namespace nezumi {

/// An existing path near `path`: each part that does not exist is replaced by the nearest name in its folder. "" if a
/// part has no near name. Ignores names that begin with a dot.
std::string near_path(const std::filesystem::path& path);

/// " (did you mean 'tests/explorer_test.lua'?)" of `near_path`, or an empty string.
std::string did_you_mean_path(const std::filesystem::path& path);

}  // namespace nezumi
