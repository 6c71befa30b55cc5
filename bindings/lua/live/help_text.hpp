// What there is to say of a component, a port, a parameter or a member to somebody who asks what it is.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

/// Explains "controller", "controller.out", "controller.config.speed_x", "controller.status" or "controller:reset",
/// over several lines. The error names the nearest there is.
Expected<std::string> help_text(const System& system, std::string_view path);

}  // namespace nezumi
