// The sheets that markers are printed on, and what is printed.
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
    Picture cells;  ///< a pixel each, with the white margin
};

/// A5, A4, A3 (ISO 216) and letter (ANSI/ASME Y14.1).
const std::vector<Paper>& papers();

/// [m] The largest black border whose marker fits on the paper with its white margin and the lines below it.
double largest_marker(const Paper& paper);

}  // namespace nezumi::draw
