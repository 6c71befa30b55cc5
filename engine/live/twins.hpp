// Adds simulated twins to real robots.
#pragma once

#include "engine/base/error.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// Adds after each real robot its twin, a simulated robot with the name NAME_twin and the same description, without
/// in-ports. An error if there is no real robot, or if such a name is taken.
Expected<void> add_twins(SystemSpec& spec);

}  // namespace nezumi
