// Vectors and rotations of three dimensions: the few operations that geometry here needs, without heavy headers.
#pragma once

#include <cmath>

namespace nezumi::sim {

struct Vec3 {
    double x = 0;
    double y = 0;
    double z = 0;

    Vec3 operator+(const Vec3& o) const { return {x + o.x, y + o.y, z + o.z}; }
    Vec3 operator-(const Vec3& o) const { return {x - o.x, y - o.y, z - o.z}; }
    Vec3 operator-() const { return {-x, -y, -z}; }
    Vec3 operator*(double s) const { return {x * s, y * s, z * s}; }
    bool operator==(const Vec3&) const = default;
};

inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalized(const Vec3& a) { return a * (1 / length(a)); }
inline bool is_finite(const Vec3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

/// A rotation, as the images of the three axes (the columns of its matrix).
struct Rotation {
    Vec3 x{1, 0, 0};
    Vec3 y{0, 1, 0};
    Vec3 z{0, 0, 1};

    /// From the rotated frame to the outer one.
    Vec3 operator*(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
    /// From the outer frame to the rotated one.
    Vec3 inverse(const Vec3& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }

    /// About the vertical.
    static Rotation yaw(double angle) {
        const double c = std::cos(angle), s = std::sin(angle);
        return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
    }
    /// First about its own y axis (positive: nose down), then about the vertical.
    static Rotation yaw_pitch(double yaw_angle, double pitch) {
        const Rotation turned = yaw(yaw_angle);
        const double c = std::cos(pitch), s = std::sin(pitch);
        return {turned.x * c - turned.z * s, turned.y, turned.x * s + turned.z * c};
    }
    bool operator==(const Rotation&) const = default;
};

}  // namespace nezumi::sim
