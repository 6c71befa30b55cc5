// The largest connected part of what is marked in a picture, and where in the picture that is.
#pragma once

#include <optional>

#include "engine/vision/checked_image.hpp"

namespace nezumi {

struct Blob {
    double x = 0;      ///< [px] its centre's column, from 0 in the middle of the first one
    double y = 0;      ///< [px] its centre's row, from 0 in the middle of the first one
    double area = 0;   ///< [px] how many it has
    double angle = 0;  ///< [rad] of its long axis: 0 upright, positive leaning to the left, -pi/2 to pi/2
};

/// The largest connected part of the pixels that are not 0, of two as large the one that begins higher; nothing when
/// all are 0. Pixels that touch at a corner are connected. The axis is that of least inertia: by the moments of second
/// order.
std::optional<Blob> largest_blob(const GrayImage& mask);

/// Where a column, or a row, lies in a picture of so many: 1 at the left, or upper, edge, -1 at the other, 0 in the
/// middle.
inline double from_middle(double place, int count) { return 1 - (2 * place + 1) / count; }

}  // namespace nezumi
