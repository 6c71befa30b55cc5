// Markers of a world. Nothing collides with them.
#pragma once

#include "engine/base/error.hpp"
#include "engine/world/arena_spec.hpp"
#include "engine/world/world.hpp"

namespace nezumi::sim {

/// Fails, with the marker's place, if the marker is not valid.
Expected<void> check_marker(const MarkerSpec& marker);

/// The initial pose of a marker.
MarkerPose pose_of(const MarkerSpec& marker);

}  // namespace nezumi::sim
