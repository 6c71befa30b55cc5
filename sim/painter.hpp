// A software painter: flat faces before a pinhole, the nearest in sight, each pixel the mean of four samples.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ports/messages.hpp"
#include "sim/geometry.hpp"
#include "sim/picture.hpp"

namespace nezumi::sim {

/// A flat, convex face. Everything is in the camera's frame [m]: x right, y down, z ahead.
struct Face {
    std::vector<Vec3> corners;  ///< in order around it
    Rgb color = 0;
    const Picture* picture = nullptr;  ///< what it shows instead of the colour; must outlive the painting
    Vec3 top_left = Vec3::Zero();      ///< of the picture
    Vec3 right = Vec3::Zero();         ///< from there to its top right corner
    Vec3 down = Vec3::Zero();          ///< and to its bottom left corner, at right angles to `right`
    double lift = 0;                   ///< [m] it hides what lies less than so far before it: for what sticks on a wall
};

/// Paints faces, in any order, over a background, as a pinhole without distortion sees them. Writes 3 bytes a pixel
/// (red, green, blue), or 1 (grey), row by row.
/// What is nearer than 1 cm is cut off.
void paint(const std::vector<Face>& faces, Rgb background, const CameraIntrinsics& pinhole, bool color,
           std::vector<std::uint8_t>& pixels);

}  // namespace nezumi::sim
