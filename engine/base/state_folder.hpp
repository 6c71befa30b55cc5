// The folder for data that a user's programs keep from run to run.
#pragma once

#include <filesystem>

namespace nezumi {

/// $XDG_STATE_HOME/nezumi, or .local/state/nezumi in the user's home: $HOME, or if that is not set, the home in the
/// system's list of users. Empty if there is no home. The folder may not exist yet.
std::filesystem::path state_folder();

}  // namespace nezumi
