// New behaviours for a running system's project.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bindings/console/session.hpp"
#include "engine/base/error.hpp"

namespace nezumi::cli {

/// Writes the behaviour's file and a scenario for it below `root`, as `nezumi new behavior` does. Returns their names.
/// Never overwrites a file.
Expected<std::vector<std::string>> write_new_behavior(const std::filesystem::path& root,
                                                      const BehaviorRequest& request);

}  // namespace nezumi::cli
