// Contacts of upright discs by our own formulas, all others by ODE.
#include "sim/narrow_phase.hpp"

#include <algorithm>

namespace nezumi::sim {
namespace {

// The range of heights that both shapes occupy.
struct Overlap {
    double low, high;
    double height() const { return high - low; }
    double middle() const { return (low + high) / 2; }
};
Overlap overlap_of(const Shape& a, const Shape& b) {
    const double ha = a.half_height(), hb = b.half_height();
    return {std::max(a.centre.z() - ha, b.centre.z() - hb), std::min(a.centre.z() + ha, b.centre.z() + hb)};
}

// In ODE's cylinder-cylinder contact one robot can slip past another, so discs have their own formula.
Touch disc_at_disc(const Shape& a, const Shape& b, double z) {
    const double dx = a.centre.x() - b.centre.x(), dy = a.centre.y() - b.centre.y(), distance = std::hypot(dx, dy);
    Touch touch;
    touch.normal = distance > 1e-9 ? Vec3{dx / distance, dy / distance, 0} : Vec3{1, 0, 0};
    touch.depth = a.half.x() + b.half.x() - distance;
    const double out = b.half.x() - touch.depth / 2;
    touch.at = {b.centre.x() + touch.normal.x() * out, b.centre.y() + touch.normal.y() * out, z};
    return touch;
}

// An upright disc against an upright box.
Touch disc_at_box(const Shape& disc, const Shape& box, double z) {
    const Vec3 from = rotate_back(box.rotation, disc.centre - box.centre);
    const double nearest_x = std::clamp(from.x(), -box.half.x(), box.half.x());
    const double nearest_y = std::clamp(from.y(), -box.half.y(), box.half.y());
    const double dx = from.x() - nearest_x, dy = from.y() - nearest_y, distance = std::hypot(dx, dy);
    Touch touch;
    Vec3 normal, at{nearest_x, nearest_y, 0};
    if (distance > 1e-9) {
        normal = {dx / distance, dy / distance, 0};
        touch.depth = disc.half.x() - distance;
    } else {  // the centre is inside: push it out through the nearest face
        const double out_x = box.half.x() - std::abs(from.x()), out_y = box.half.y() - std::abs(from.y());
        if (out_x < out_y) {
            normal = {from.x() < 0 ? -1.0 : 1.0, 0, 0};
        } else {
            normal = {0, from.y() < 0 ? -1.0 : 1.0, 0};
        }
        touch.depth = disc.half.x() + std::min(out_x, out_y);
    }
    touch.normal = rotate(box.rotation, normal);
    touch.at = box.centre + rotate(box.rotation, at);
    touch.at.z() = z;
    return touch;
}

void set_geom(dGeomID geom, const Shape& shape) {
    if (shape.kind == Shape::Kind::box) {
        dGeomBoxSetLengths(geom, 2 * shape.half.x(), 2 * shape.half.y(), 2 * shape.half.z());
    } else {
        dGeomCylinderSetParams(geom, shape.half.x(), 2 * shape.half.z());
    }
    dGeomSetPosition(geom, shape.centre.x(), shape.centre.y(), shape.centre.z());
    RowMajor3x4 matrix = RowMajor3x4::Zero();
    matrix.leftCols<3>() = shape.rotation;
    dGeomSetRotation(geom, matrix.data());
}

// A convex polygon in the plane of a wheel. The origin is the wheel's centre: u forward, v up.
struct Polygon {
    struct Corner {
        double u = 0, v = 0;
    };
    std::array<Corner, 12> corners{};
    std::size_t size = 0;
    void add(double u, double v) {
        if (size < corners.size()) corners[size++] = {u, v};
    }
};

// The intersection of the wheel's plane with a box.
void cut_box(const Shape& box, const Vec3& centre, const Vec3& axis, const Vec3& forward, const Vec3& up,
             Polygon& cut) {
    const Rotation& r = box.rotation;
    const Vec3 edges[3] = {r.col(0) * box.half.x(), r.col(1) * box.half.y(), r.col(2) * box.half.z()};
    for (int along = 0; along < 3; ++along) {
        const Vec3 &e = edges[along], &s = edges[(along + 1) % 3], &t = edges[(along + 2) % 3];
        for (int corner = 0; corner < 4; ++corner) {
            const Vec3 middle =
                box.centre + s * ((corner & 1) != 0 ? 1.0 : -1.0) + t * ((corner & 2) != 0 ? 1.0 : -1.0) - centre;
            const double a = dot(middle - e, axis), b = dot(middle + e, axis);
            if ((a < 0) == (b < 0)) continue;
            const Vec3 at = middle + e * ((a + b) / (a - b));
            cut.add(dot(at, forward), dot(at, up));
        }
    }
    if (cut.size < 3) return;
    double u = 0, v = 0;
    for (std::size_t i = 0; i < cut.size; ++i) {
        u += cut.corners[i].u / static_cast<double>(cut.size);
        v += cut.corners[i].v / static_cast<double>(cut.size);
    }
    std::sort(cut.corners.begin(), cut.corners.begin() + static_cast<std::ptrdiff_t>(cut.size),
              [&](const Polygon::Corner& a, const Polygon::Corner& b) {
                  return std::atan2(a.v - v, a.u - u) < std::atan2(b.v - v, b.u - u);
              });
}

// The cut of an upright cylinder and a wheel that is about upright.
void cut_cylinder(const Shape& cylinder, const Vec3& centre, const Vec3& axis, const Vec3& forward, Polygon& cut) {
    const Vec3 from = cylinder.centre - centre;
    const double aside = dot({from.x(), from.y(), 0}, axis);
    if (std::abs(aside) >= cylinder.half.x()) return;
    const double half = std::sqrt(cylinder.half.x() * cylinder.half.x() - aside * aside);
    const double middle = dot({from.x(), from.y(), 0}, forward);
    cut.add(middle - half, from.z() - cylinder.half.z());
    cut.add(middle + half, from.z() - cylinder.half.z());
    cut.add(middle + half, from.z() + cylinder.half.z());
    cut.add(middle - half, from.z() + cylinder.half.z());
}

}  // namespace

NarrowPhase::NarrowPhase() {
    for (auto& pair : geoms_) {
        pair[0] = GeomHandle(dCreateBox(nullptr, 1, 1, 1));
        pair[1] = GeomHandle(dCreateCylinder(nullptr, 1, 1));
    }
}

std::span<const Touch> NarrowPhase::collide(const Shape& a, const Shape& b) {
    const Overlap overlap = overlap_of(a, b);
    if (overlap.height() <= 0) return {};
    const bool a_disc = a.kind == Shape::Kind::cylinder, b_disc = b.kind == Shape::Kind::cylinder;
    // A driving robot pitches a little; a fallen thing leans or lies. The limit of 0.97 is 14 degrees.
    const auto stands = [](const Shape& s) { return std::abs(s.rotation(2, 2)) > 0.97; };
    if ((a_disc || b_disc) && stands(a) && stands(b)) {
        Touch touch;
        if (a_disc && b_disc) {
            touch = disc_at_disc(a, b, overlap.middle());
        } else if (a_disc) {
            touch = disc_at_box(a, b, overlap.middle());
        } else {
            touch = disc_at_box(b, a, overlap.middle());
            touch.normal = -touch.normal;
        }
        if (touch.depth <= 0) return {};
        if (touch.depth <= overlap.height()) {
            touches_[0] = touch;
            return std::span(touches_).first(1);
        }
        // If the depth exceeds the common height, one shape stands on the other: ODE computes this case.
    }
    return collide_by_ode(a, b);
}

std::span<const Touch> NarrowPhase::collide_by_ode(const Shape& a, const Shape& b) {
    dGeomID ga = geoms_[0][a.kind == Shape::Kind::box ? 0 : 1].get();
    dGeomID gb = geoms_[1][b.kind == Shape::Kind::box ? 0 : 1].get();
    set_geom(ga, a);
    set_geom(gb, b);
    std::array<dContactGeom, most_touches> found{};
    const int count = dCollide(ga, gb, static_cast<int>(most_touches), found.data(), sizeof(dContactGeom));
    std::size_t kept = 0;
    for (int i = 0; i < count; ++i) {
        const dContactGeom& c = found[static_cast<std::size_t>(i)];
        const Touch touch{Eigen::Map<const Vec3>(c.pos), Eigen::Map<const Vec3>(c.normal), c.depth};
        if (c.depth > 0 && touch.at.allFinite() && touch.normal.allFinite()) touches_[kept++] = touch;
    }
    return std::span(touches_).first(kept);
}

std::optional<Touch> touch_wheel(const Shape& shape, const Vec3& centre, const Vec3& axis, double radius) {
    constexpr double steepest = 0.2;  // a shape whose normal has a smaller upward part is a wall
    const Vec3 level = axis.cross(Vec3::UnitZ());
    const double flat = level.norm();
    if (flat < 0.3) return std::nullopt;  // the wheel lies on its side
    const Vec3 forward = level * (1 / flat), up = forward.cross(axis);

    Polygon cut;
    if (shape.kind == Shape::Kind::box) {
        cut_box(shape, centre, axis, forward, up, cut);
    } else if (shape.is_upright()) {
        cut_cylinder(shape, centre, axis, forward, cut);
    }
    if (cut.size < 3) return std::nullopt;

    bool inside = true;
    double nearest = nothing, u = 0, v = 0;
    for (std::size_t i = 0; i < cut.size; ++i) {
        const auto &a = cut.corners[i], &b = cut.corners[(i + 1) % cut.size];
        const double du = b.u - a.u, dv = b.v - a.v, squared = du * du + dv * dv;
        if (squared < 1e-18) continue;
        if (du * -a.v - dv * -a.u < 0) inside = false;  // the origin is to the right of an edge
        const double t = std::clamp(-(a.u * du + a.v * dv) / squared, 0.0, 1.0);
        const double pu = a.u + t * du, pv = a.v + t * dv, distance = std::hypot(pu, pv);
        if (distance < nearest) {
            nearest = distance;
            u = pu;
            v = pv;
        }
    }
    if (inside || nearest >= radius || nearest < radius / 2) return std::nullopt;
    const Vec3 normal = (forward * -u + up * -v) * (1 / nearest);
    if (normal.z() < steepest) return std::nullopt;
    return Touch{centre + forward * u + up * v, normal, radius - nearest};
}

}  // namespace nezumi::sim
