// The path that was meant where one leads nowhere.
#pragma once

#include <filesystem>
#include <string>

namespace nezumi {

/// A path like this one that leads somewhere, each of its parts the nearest name that its folder has; "" when a part is
/// near to nothing. Names that begin with a dot are not considered.
std::string near_path(const std::filesystem::path& path);

/// " (did you mean 'tests/explorer_test.lua'?)" of `near_path`, or an empty string.
std::string did_you_mean_path(const std::filesystem::path& path);

}  // namespace nezumi
