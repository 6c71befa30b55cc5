// Where a user's programs keep what they remember from one run to the next.
#pragma once

#include <filesystem>

namespace nezumi {

/// $XDG_STATE_HOME/nezumi, or .local/state/nezumi in the user's home: $HOME, or where that is not set the one that the
/// computer's list of users has. Empty where there is none. It may not be there yet.
std::filesystem::path state_folder();

}  // namespace nezumi
