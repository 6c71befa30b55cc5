// What a sensor that looks down sees of the floor's picture.
#pragma once

#include <optional>

#include "engine/ports/messages.hpp"
#include "engine/world/floor_color.hpp"
#include "sim/picture.hpp"

namespace nezumi::sim {

/// The mean colour of a spot of 4 mm radius about `at` [m] on a picture of this size [m], centred on the origin, its
/// top where y is largest. Parts of the spot beside the picture don't count; nothing when its centre is beside it.
std::optional<Rgb> look_at_floor(const Picture& picture, const Point2D& size, const Point2D& at);

/// The colour's name as a colour sensor gives it: by hue, or black and white where there is little of it.
FloorColor nearest_floor_color(Rgb color);

/// 0 (black) to 100 (white): the luma of ITU-R BT.601.
double brightness(Rgb color);

}  // namespace nezumi::sim
