// System files from RTSystemEditor's profiles.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bindings/lua/script/script.hpp"
#include "bindings/openrtm/system_profile.hpp"

namespace nezumi::cli {

/// Loads the behaviour of this name; null if there is none.
using BehaviorFinder = std::function<std::unique_ptr<Script>(const std::string& script)>;

/// A system file in which components whose types are behaviours are these behaviours, with their configuration; all
/// others stay RTCs, to which they are connected. Things that a system file can't express become comments and lines of
/// `remarks`.
std::string system_text_of(const openrtm::SystemProfile& profile, const BehaviorFinder& find,
                           std::vector<std::string>& remarks);

}  // namespace nezumi::cli
