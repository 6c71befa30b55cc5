// The largest connected region of marked pixels, and its place in the picture.
#pragma once

#include <optional>

#include "engine/vision/checked_image.hpp"

namespace nezumi {

struct Blob {
    double x = 0;      ///< [px] column of its centre; 0 is the middle of the first column
    double y = 0;      ///< [px] row of its centre; 0 is the middle of the first row
    double area = 0;   ///< [px] number of pixels
    double angle = 0;  ///< [rad] of its long axis: 0 vertical, positive if it leans to the left, -pi/2 to pi/2
};

/// Returns the largest connected region of pixels that are not 0; of two equal ones, the one that begins higher;
/// nothing if all are 0. Pixels that touch at a corner are connected. The axis is that of least inertia, from the
/// second moments.
std::optional<Blob> largest_blob(const GrayImage& mask);

/// The relative position of a column or row among `count`: 1 at the left or upper edge, -1 at the other, 0 in the
/// middle.
inline double from_middle(double place, int count) { return 1 - (2 * place + 1) / count; }

}  // namespace nezumi
