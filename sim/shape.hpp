// Boxes and cylinders in the world, and where a ray meets them.
#pragma once

#include <cstdint>
#include <limits>

#include "sim/geometry.hpp"
#include "sim/lanes.hpp"

namespace nezumi::sim {

/// No hit, nothing in sight.
inline constexpr double nothing = std::numeric_limits<double>::infinity();

/// A box, or a cylinder about its own z axis.
struct Shape {
    enum class Kind : std::uint8_t { box, cylinder };

    Kind kind = Kind::box;
    Vec3 centre = Vec3::Zero();                ///< [m] in the world
    Rotation rotation = Rotation::Identity();  ///< from the shape's frame to the world
    Vec3 half = Vec3::Zero();  ///< [m] half the edges of a box; a cylinder: radius, radius, half its height

    /// [m] Radius of the upright cylinder about the centre that holds the shape, however it has turned.
    double reach() const;
    /// [m] Half the height of the shape as it stands now.
    double half_height() const { return half_height_at(rotation); }
    /// The same as if it stood so.
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

/// Distance along the ray from `from` in direction `direction` (a unit vector) to the shape, at most `range`. 0 when
/// `from` lies inside, `nothing` when there is no hit. With `normal`, the outward normal of the surface that was hit.
double cast_ray(const Shape& shape, const Vec3& from, const Vec3& direction, double range, Vec3* normal = nullptr);

/// Distance [m] from (x, y) to the shape as seen from above: 0 inside. Exact for upright shapes, and never too large.
double distance_from_above(const Shape& shape, double x, double y);

}  // namespace nezumi::sim
