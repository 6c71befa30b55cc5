// Vectors and rotations: short names for Eigen's, and operations whose results are the same to the last bit.
#pragma once

#include <Eigen/Geometry>

#include "engine/ports/messages.hpp"

namespace nezumi::sim {

using Vec3 = Eigen::Vector3d;
/// From the rotated frame to the outer one. The columns are the axes of the rotated frame.
using Rotation = Eigen::Matrix3d;
/// ODE's layout of a rotation; the last column is unused.
using RowMajor3x4 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

// Sums three terms in the order of the axes. Eigen adds the last two first, which changes the last bit. Simulated
// motion uses these functions, so that traces stay the same.
inline double dot(const Vec3& a, const Vec3& b) { return a.x() * b.x() + a.y() * b.y() + a.z() * b.z(); }
/// From the rotated frame to the outer one.
inline Vec3 rotate(const Rotation& r, const Vec3& v) { return r.col(0) * v.x() + r.col(1) * v.y() + r.col(2) * v.z(); }
/// From the outer frame to the rotated one.
inline Vec3 rotate_back(const Rotation& r, const Vec3& v) {
    return {dot(r.col(0), v), dot(r.col(1), v), dot(r.col(2), v)};
}

/// Rotation about the vertical axis [rad].
Rotation yaw_rotation(double angle);
/// First about the y axis (positive: nose down), then about the vertical.
Rotation yaw_pitch_rotation(double yaw_angle, double pitch_angle);
/// First roll about x, then pitch about y, then yaw about z.
Rotation rotation_of(const Orientation3D& orientation);

inline Vec3 to_vec(const Point3D& p) { return {p.x, p.y, p.z}; }
inline Point3D to_point(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace nezumi::sim
