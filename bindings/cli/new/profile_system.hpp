// System files from RTSystemEditor's profiles.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bindings/lua/script/script.hpp"
#include "bindings/openrtm/system_profile.hpp"

namespace nezumi::cli {

/// Loads the behaviour of this name; null if none can be loaded.
using BehaviorFinder = std::function<std::unique_ptr<Script>(const std::string& script)>;

/// The text of a system file. A component whose type is a behaviour becomes this behaviour, with its configuration. All
/// other components stay RTCs, and the behaviours are connected to them. Things that a system file can't express become
/// comments and lines of `remarks`.
std::string system_text_of(const openrtm::SystemProfile& profile, const BehaviorFinder& find,
                           std::vector<std::string>& remarks);

}  // namespace nezumi::cli
