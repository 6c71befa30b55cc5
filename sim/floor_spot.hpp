// What a downward-looking sensor sees of the floor's picture.
#pragma once

#include <optional>

#include "engine/ports/messages.hpp"
#include "sim/picture.hpp"

namespace nezumi::sim {

/// Returns the mean colour of a spot of 4 mm radius about `at` [m]. The picture has this size [m], is centred on the
/// origin, and its top is at the largest y. Parts of the spot outside the picture don't count. Returns nothing if the
/// centre of the spot is outside.
std::optional<Rgb> floor_spot_color(const Picture& picture, const Point2D& size, const Point2D& at);

}  // namespace nezumi::sim
