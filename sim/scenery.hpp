// What there is to see at one moment, and the faces that a camera would see of it.
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

/// A picture on an upright or tilted square without thickness; its back is plain. The frame has x out of the picture, y
/// to the right of who looks at it, z up.
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
    Point2D floor_size{};            ///< [m] of the picture, centred on the origin; its top is where y is largest
};

/// From where it is looked at; the frame has x forward, y left, z up.
struct View {
    Vec3 at = Vec3::Zero();
    Rotation rotation = Rotation::Identity();
};

/// Of a floor without a picture.
inline constexpr Rgb plain_floor_color = 0xc9c4ba;
/// The colour over the horizon.
inline constexpr Rgb sky = 0xdfe6ee;

/// The faces that are turned towards the view, in its camera frame. The pictures must outlive them.
std::vector<Face> faces_of(const Scenery& scenery, const View& view);

}  // namespace nezumi::sim
