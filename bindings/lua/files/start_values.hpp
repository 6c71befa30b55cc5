// Values of parameters that whoever starts a system puts in place of the system file's.
#pragma once

#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/project/project.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// Both are taken again at every start of the system: `restart` keeps them.
struct StartValues {
    std::string file;              ///< a system file, as `save` writes it, whose parameters and sets hold; "" for none
    std::vector<std::string> set;  ///< "controller.speed_x=0.3", the last of a parameter counts; over those of `file`
};

/// Puts them into `spec`. `project` finds what the file names. What the parameters themselves refuse is left to
/// `build_system`, which then names the option, or the line of the file.
Expected<void> apply(const StartValues& values, SystemSpec& spec, const Project& project);

}  // namespace nezumi
