// Sheets for printing markers, and the printed tags.
#pragma once

#include <string_view>
#include <vector>

#include "engine/world/picture.hpp"

namespace nezumi::draw {

struct Paper {
    std::string_view name;
    double width;   ///< [m]
    double height;  ///< [m]
};

/// A tag of AprilTag's family 36h11.
struct PrintedTag {
    int id = 0;
    Picture cells;  ///< one pixel per cell, with the white margin
};

/// A5, A4, A3 (ISO 216) and letter (ANSI/ASME Y14.1).
const std::vector<Paper>& papers();

/// [m] The largest black border for this paper, with the white margin and the text below.
double largest_marker(const Paper& paper);

}  // namespace nezumi::draw
