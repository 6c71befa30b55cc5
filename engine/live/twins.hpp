// Simulated robots beside real ones.
#pragma once

#include "engine/base/error.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// Puts after each real robot its twin, a simulated one called NAME_twin with the same description, without in-ports.
/// An error when there is no real robot, or when such a name is taken.
Expected<void> add_twins(SystemSpec& spec);

}  // namespace nezumi
