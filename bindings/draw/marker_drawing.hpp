// One page with a marker, drawn with cairo.
#pragma once

#include <cairo.h>

#include "bindings/draw/paper.hpp"

namespace nezumi::draw {

/// Draws the tag in the middle of the sheet, and below it its number, its size and a line for checking the scale. The
/// units of the context must be metres, from the top left corner. `size` [m] is the edge of the black border, at most
/// `largest_marker`.
void draw_marker(cairo_t* context, const Paper& paper, const PrintedTag& tag, double size);

}  // namespace nezumi::draw
