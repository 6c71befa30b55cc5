// Pictures on surfaces: read from a file, or painted as a marker.
#pragma once

#include <string>

#include "engine/base/error.hpp"
#include "engine/world/picture.hpp"

namespace nezumi::sim {

/// Reads a picture file: PNG, or any format of OpenCV by a module that is loaded on demand. Transparent parts become
/// white. An error gives the reason.
Expected<Picture> read_picture(const std::string& file);

/// "#rrggbb" as a colour; grey for anything else.
Rgb parse_color(const std::string& text);

/// Paints tag `id` of AprilTag's family 36h11 with its white margin, one pixel per cell.
Picture paint_tag(int id);

}  // namespace nezumi::sim
