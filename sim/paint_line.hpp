// Paints lines on the floor.
#pragma once

#include "engine/world/arena_spec.hpp"
#include "sim/picture.hpp"

namespace nezumi::sim {

/// Returns a plain floor of this size [m] to paint on. A pixel is 1 mm, or more for a large floor.
Picture plain_floor(const Point2D& size);

/// Paints a line on the picture of a floor of this size [m]. The picture is centred on the origin, its top at the
/// largest y.
void paint_line(Picture& floor, const Point2D& size, const LineSpec& line);

}  // namespace nezumi::sim
