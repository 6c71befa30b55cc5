// A software renderer: flat faces in front of a pinhole camera, with a depth buffer and four samples per pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ports/messages.hpp"
#include "sim/geometry.hpp"
#include "sim/picture.hpp"

namespace nezumi::sim {

/// A flat, convex face. All vectors are in the camera frame [m]: x right, y down, z ahead.
struct Face {
    std::vector<Vec3> corners;  ///< in order around it
    Rgb color = 0;
    const Picture* picture = nullptr;  ///< drawn instead of the colour; must outlive the painting
    Vec3 top_left = Vec3::Zero();      ///< of the picture
    Vec3 right = Vec3::Zero();         ///< vector to the picture's top right corner
    Vec3 down = Vec3::Zero();          ///< vector to the picture's bottom left corner, perpendicular to `right`
    double lift = 0;  ///< [m] the face hides what is less than this in front of it: for pictures on a wall
};

/// Paints faces, in any order, over a background, as a pinhole camera without distortion sees them. Writes rows of 3
/// bytes (red, green, blue) or 1 byte (grey) per pixel. Cuts off what is nearer than 1 cm.
void paint(const std::vector<Face>& faces, Rgb background, const CameraIntrinsics& pinhole, bool color,
           std::vector<std::uint8_t>& pixels);

}  // namespace nezumi::sim
