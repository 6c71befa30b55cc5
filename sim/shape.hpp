// Boxes and cylinders in the world, and ray intersections with them.
#pragma once

#include <cstdint>
#include <limits>

#include "sim/geometry.hpp"
#include "sim/lanes.hpp"

namespace nezumi::sim {

/// The distance if there is no hit.
inline constexpr double nothing = std::numeric_limits<double>::infinity();

/// A box, or a cylinder about its own z axis.
struct Shape {
    enum class Kind : std::uint8_t { box, cylinder };

    Kind kind = Kind::box;
    Vec3 centre = Vec3::Zero();                ///< [m] in the world
    Rotation rotation = Rotation::Identity();  ///< from the shape's frame to the world
    Vec3 half = Vec3::Zero();  ///< [m] half the edges of a box; a cylinder: radius, radius, half its height

    /// Radius [m] of the upright cylinder about the centre that contains the shape at any rotation.
    double reach() const;
    /// Half the height [m] of the shape at its present rotation.
    double half_height() const { return half_height_at(rotation); }
    /// Half the height [m] of the shape at another rotation.
    template <class Real>
    Real half_height_at(const Eigen::Matrix<Real, 3, 3>& how) const;
    /// Whether its own z axis is vertical, up or down, within 0.01 rad.
    bool is_upright() const;
};

template <class Real>
Real Shape::half_height_at(const Eigen::Matrix<Real, 3, 3>& how) const {
    const Real along = magnitude(how(2, 2)) * half.z();
    if (kind == Kind::box) return along + magnitude(how(2, 0)) * half.x() + magnitude(how(2, 1)) * half.y();
    return along + half.x() * root(greater(Real(0.0), 1 - how(2, 2) * how(2, 2)));
}

/// Returns the distance along the ray from `from` in direction `direction` (a unit vector) to the shape, at most
/// `range`: 0 if `from` is inside, `nothing` if there is no hit. `normal`, if given, gets the outward normal of the
/// surface at the hit.
double cast_ray(const Shape& shape, const Vec3& from, const Vec3& direction, double range, Vec3* normal = nullptr);

/// Distance [m] from (x, y) to the shape seen from above: 0 inside. Exact for upright shapes, otherwise a lower bound.
double distance_from_above(const Shape& shape, double x, double y);

/// The gap [m] between two shapes seen from above, 0 if they overlap. Exact for upright shapes that do not overlap,
/// otherwise a lower bound.
double gap_from_above(const Shape& a, const Shape& b);

}  // namespace nezumi::sim
