// Markers of a world: they hang where they are and touch nothing.
#pragma once

#include "engine/base/error.hpp"
#include "engine/world/arena_spec.hpp"
#include "engine/world/world.hpp"

namespace nezumi::sim {

/// An error, with the marker's place, when it is none that can be seen.
Expected<void> check_marker(const MarkerSpec& marker);

/// Where it hangs at first.
MarkerPose pose_of(const MarkerSpec& marker);

}  // namespace nezumi::sim
