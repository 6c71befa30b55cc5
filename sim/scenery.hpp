// The visible objects at one moment, and the faces that a camera sees of them.
#pragma once

#include <optional>
#include <vector>

#include "engine/ports/messages.hpp"
#include "sim/painter.hpp"
#include "sim/shape.hpp"

namespace nezumi::sim {

/// A shape of one colour.
struct Solid {
    Shape shape;
    Rgb color = 0;
};

/// A picture on a square without thickness; its back is plain. In its frame x points out of the picture, y to the
/// viewer's right, z up.
struct Sign {
    const Picture* picture = nullptr;
    double edge = 0;  ///< [m]
    Vec3 centre = Vec3::Zero();
    Rotation rotation = Rotation::Identity();
};

struct Scenery {
    std::vector<Solid> solids;
    std::vector<Sign> signs;
    const Picture* floor = nullptr;  ///< nullptr: a plain floor
    Point2D floor_size{};            ///< [m] size of the picture, centred on the origin; its top is at the largest y
};

/// The viewer's pose: x forward, y left, z up.
struct View {
    Vec3 at = Vec3::Zero();
    Rotation rotation = Rotation::Identity();
};

/// The colour of a floor without a picture.
inline constexpr Rgb plain_floor_color = 0xc9c4ba;
/// The colour above the horizon.
inline constexpr Rgb sky = 0xdfe6ee;

/// Returns the faces turned towards the view, in the camera frame. The pictures must outlive them.
std::vector<Face> faces_of(const Scenery& scenery, const View& view);

}  // namespace nezumi::sim
