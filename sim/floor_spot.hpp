// What a sensor that looks down sees of the floor's picture.
#pragma once

#include <optional>

#include "engine/ports/messages.hpp"
#include "sim/picture.hpp"

namespace nezumi::sim {

/// The mean colour of a spot of 4 mm radius about `at` [m] on a picture of this size [m], centred on the origin, its
/// top where y is largest. Parts of the spot beside the picture don't count; nothing when its centre is beside it.
std::optional<Rgb> floor_spot_color(const Picture& picture, const Point2D& size, const Point2D& at);

}  // namespace nezumi::sim
