// Ray intersections with boxes and cylinders, in the shape's own frame.
#include "sim/shape.hpp"

#include <algorithm>

namespace nezumi::sim {
namespace {

// Narrows [near, far], the part of the line within the slab |from + t * direction| <= half. Returns false if nothing is
// left.
bool clip_to_slab(double from, double direction, double half, double& near, double& far, bool& entered) {
    entered = false;
    if (direction == 0) return std::abs(from) <= half;
    const double inverse = 1 / direction;
    const double a = (-half - from) * inverse, b = (half - from) * inverse;
    const double enter = std::min(a, b), leave = std::max(a, b);
    if (enter > near) {
        near = enter;
        entered = true;
    }
    far = std::min(far, leave);
    return near <= far;
}

double sign(double v) { return v < 0 ? -1 : 1; }

double cast_at_box(const Vec3& half, const Vec3& from, const Vec3& direction, double range, Vec3* normal) {
    double near = 0, far = range;
    bool entered = false;
    int axis = -1;
    if (!clip_to_slab(from.x(), direction.x(), half.x(), near, far, entered)) return nothing;
    if (entered) axis = 0;
    if (!clip_to_slab(from.y(), direction.y(), half.y(), near, far, entered)) return nothing;
    if (entered) axis = 1;
    if (!clip_to_slab(from.z(), direction.z(), half.z(), near, far, entered)) return nothing;
    if (entered) axis = 2;
    if (normal != nullptr) {
        *normal = -direction;
        if (axis == 0) *normal = {-sign(direction.x()), 0, 0};
        if (axis == 1) *normal = {0, -sign(direction.y()), 0};
        if (axis == 2) *normal = {0, 0, -sign(direction.z())};
    }
    return near;
}

double cast_at_cylinder(double radius, double half_height, const Vec3& from, const Vec3& direction, double range,
                        Vec3* normal) {
    double near = 0, far = range;
    bool by_cap = false, by_side = false;
    if (!clip_to_slab(from.z(), direction.z(), half_height, near, far, by_cap)) return nothing;
    // |from + t * direction|^2 = radius^2, seen along the axis.
    const double a = direction.x() * direction.x() + direction.y() * direction.y();
    const double b = from.x() * direction.x() + from.y() * direction.y();
    const double c = from.x() * from.x() + from.y() * from.y() - radius * radius;
    if (a < 1e-30) {
        if (c > 0) return nothing;
    } else {
        const double discriminant = b * b - a * c;
        if (discriminant < 0) return nothing;
        const double root = std::sqrt(discriminant);
        const double enter = (-b - root) / a;
        if (enter > near) {
            near = enter;
            by_side = true;
        }
        far = std::min(far, (-b + root) / a);
        if (near > far) return nothing;
    }
    if (normal != nullptr) {
        *normal = -direction;
        if (by_side) {
            *normal = Vec3{from.x() + near * direction.x(), from.y() + near * direction.y(), 0} * (1 / radius);
        } else if (by_cap) {
            *normal = {0, 0, -sign(direction.z())};
        }
    }
    return near;
}

}  // namespace

double Shape::reach() const {
    return kind == Kind::box ? half.norm() : std::sqrt(half.x() * half.x() + half.z() * half.z());
}

bool Shape::is_upright() const { return std::abs(rotation(2, 2)) > 0.99995; }

double cast_ray(const Shape& shape, const Vec3& from, const Vec3& direction, double range, Vec3* normal) {
    const Vec3 local_from = rotate_back(shape.rotation, from - shape.centre);
    const Vec3 local_direction = rotate_back(shape.rotation, direction);
    const double distance =
        shape.kind == Shape::Kind::box
            ? cast_at_box(shape.half, local_from, local_direction, range, normal)
            : cast_at_cylinder(shape.half.x(), shape.half.z(), local_from, local_direction, range, normal);
    if (normal != nullptr && distance < nothing) *normal = rotate(shape.rotation, *normal);
    return distance;
}

double distance_from_above(const Shape& shape, double x, double y) {
    const double dx = x - shape.centre.x(), dy = y - shape.centre.y();
    if (!shape.is_upright()) return std::max(0.0, std::hypot(dx, dy) - shape.reach());
    if (shape.kind == Shape::Kind::cylinder) return std::max(0.0, std::hypot(dx, dy) - shape.half.x());
    const double along = std::abs(dx * shape.rotation(0, 0) + dy * shape.rotation(1, 0)) - shape.half.x();
    const double across = std::abs(dx * shape.rotation(0, 1) + dy * shape.rotation(1, 1)) - shape.half.y();
    return std::hypot(std::max(0.0, along), std::max(0.0, across));
}

namespace {

// The least distance from the corners of an upright box to the other shape.
double gap_at_corners(const Shape& box, const Shape& other) {
    double least = nothing;
    for (const double x : {-box.half.x(), box.half.x()}) {
        for (const double y : {-box.half.y(), box.half.y()}) {
            const Vec3 corner = box.centre + rotate(box.rotation, {x, y, 0});
            least = std::min(least, distance_from_above(other, corner.x(), corner.y()));
        }
    }
    return least;
}

bool is_upright_box(const Shape& shape) { return shape.kind == Shape::Kind::box && shape.is_upright(); }

}  // namespace

double gap_from_above(const Shape& a, const Shape& b) {
    // Two boxes that do not overlap are nearest to each other at a corner.
    if (is_upright_box(a) && is_upright_box(b)) {
        const bool overlap = distance_from_above(a, b.centre.x(), b.centre.y()) == 0 ||
                             distance_from_above(b, a.centre.x(), a.centre.y()) == 0;
        return overlap ? 0 : std::min(gap_at_corners(a, b), gap_at_corners(b, a));
    }
    // The other shape is taken as a disc, which is exact for an upright cylinder.
    const Shape& disc = is_upright_box(a) ? b : a;
    const Shape& other = is_upright_box(a) ? a : b;
    const double radius = disc.kind == Shape::Kind::cylinder && disc.is_upright() ? disc.half.x() : disc.reach();
    return std::max(0.0, distance_from_above(other, disc.centre.x(), disc.centre.y()) - radius);
}

}  // namespace nezumi::sim
