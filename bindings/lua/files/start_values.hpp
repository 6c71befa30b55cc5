// Values of parameters that whoever starts a system puts in place of the system file's.
#pragma once

#include "engine/base/error.hpp"
#include "engine/live/script_host.hpp"
#include "engine/project/project.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// Puts them into `spec`. `project` finds what the file names. What the parameters themselves refuse is left to
/// `build_system`, which then names the option, or the line of the file.
Expected<void> apply(const StartValues& values, SystemSpec& spec, const Project& project);

}  // namespace nezumi
