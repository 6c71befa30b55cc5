// The points where two shapes touch, and where a wheel touches a shape.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "sim/ode_library.hpp"
#include "sim/shape.hpp"

namespace nezumi::sim {

/// A point where `a` and `b` touch.
struct Touch {
    Vec3 at = Vec3::Zero();      ///< [m] in the world
    Vec3 normal = Vec3::Zero();  ///< a unit vector that points into `a`: moving `a` along it by `depth` separates them
    double depth = 0;            ///< [m]
};

class NarrowPhase {
public:
    static constexpr std::size_t most_touches = 4;

    NarrowPhase();

    /// Returns the points where the two touch, or none. Valid until the next call.
    std::span<const Touch> collide(const Shape& a, const Shape& b);

private:
    std::span<const Touch> collide_by_ode(const Shape& a, const Shape& b);

    std::array<std::array<GeomHandle, 2>, 2> geoms_;  // for a and b, a box and a cylinder each
    std::array<Touch, most_touches> touches_;
};

/// Returns the point where a wheel, a thin disc, touches a shape that it can roll over: a kerb, a ramp, a box on the
/// floor. Returns nothing for a wall (the hull stops at it) and for a shape higher than the axle. `axis` is a unit
/// vector.
std::optional<Touch> touch_wheel(const Shape& shape, const Vec3& centre, const Vec3& axis, double radius);

}  // namespace nezumi::sim
