// Pictures that lie on surfaces: a file's, a marker's.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/world/floor_color.hpp"

namespace nezumi::sim {

struct Picture {
    int width = 0;
    int height = 0;
    std::vector<Rgb> pixels;  ///< row by row from the top left
};

/// Reads a picture's file: PNG, or with a module that is loaded then, what else OpenCV can read. Transparent parts are
/// white. An error says what the matter with the file is.
Expected<Picture> read_picture(const std::string& file);

/// "#rrggbb" as a colour; grey for anything else.
Rgb parse_color(const std::string& text);

/// The tag `id` of AprilTag's family 36h11 with its white margin: 10 x 10 cells, of which the black border's outer
/// edges enclose 8 x 8.
Picture paint_tag(int id);
inline constexpr int tag_cells = 10, tag_border_cells = 8;
inline constexpr int tag_count = 587;  ///< of the family

}  // namespace nezumi::sim
