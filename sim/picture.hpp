// Makes pictures that lie on surfaces: from a file, of a marker.
#pragma once

#include <string>

#include "engine/base/error.hpp"
#include "engine/world/picture.hpp"

namespace nezumi::sim {

/// Reads a picture's file: PNG, or with a module that is loaded then, what else OpenCV can read. Transparent parts are
/// white. An error says what the matter with the file is.
Expected<Picture> read_picture(const std::string& file);

/// "#rrggbb" as a colour; grey for anything else.
Rgb parse_color(const std::string& text);

/// The tag `id` of AprilTag's family 36h11 with its white margin: a pixel for each cell.
Picture paint_tag(int id);

}  // namespace nezumi::sim
