// Paints lines on the floor.
#pragma once

#include "engine/world/arena_spec.hpp"
#include "sim/picture.hpp"

namespace nezumi::sim {

/// A plain floor of this size [m] to paint on: a pixel is 1 mm, or more where the floor is large.
Picture plain_floor(const Point2D& size);

/// Paints a line on the picture of a floor of this size [m], centred on the origin, its top where y is largest.
void paint_line(Picture& floor, const Point2D& size, const LineSpec& line);

}  // namespace nezumi::sim
