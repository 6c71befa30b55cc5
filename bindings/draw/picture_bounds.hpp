// What a picture of a world has to have room for.
#pragma once

#include <algorithm>
#include <vector>

#include "bindings/draw/picture.hpp"

namespace nezumi::draw {

/// A rectangle [m], empty at first.
struct Bounds {
    double left = 1e9, right = -1e9, bottom = 1e9, top = -1e9;
    void include(double x, double y, double reach) {
        left = std::min(left, x - reach);
        right = std::max(right, x + reach);
        bottom = std::min(bottom, y - reach);
        top = std::max(top, y + reach);
    }
};

/// The outline of a box from above [m], whichever way it lies, anticlockwise.
std::vector<Point2D> outline(const ThingPose& thing);

/// Without what has left the world of numbers: one such coordinate would spoil the whole drawing.
PictureOf only_finite(PictureOf picture);

/// Of things, robots with their paths, and the floor's picture; half a metre around the middle where there is nothing.
Bounds bounds_of(const PictureOf& picture);

}  // namespace nezumi::draw
