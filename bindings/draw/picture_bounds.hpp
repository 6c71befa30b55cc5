// The bounds of a picture of a world.
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

/// The outline of a box seen from above [m], at any rotation, anticlockwise.
std::vector<Point2D> outline(const ThingPose& thing);

/// Removes everything with coordinates that are not finite: with one of them nothing could be drawn.
PictureOf only_finite(PictureOf picture);

/// The bounds of things, robots with their paths, and the floor's picture; 0.5 m around the origin if there is nothing.
Bounds bounds_of(const PictureOf& picture);

}  // namespace nezumi::draw
