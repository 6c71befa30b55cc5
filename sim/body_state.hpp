// Pose and velocities of bodies, independent of ODE: of one robot, or of several robots in lanes.
#pragma once

#include <array>

#include "sim/geometry.hpp"
#include "sim/lanes.hpp"

namespace nezumi::sim {

// `Real` is double, or Lanes for several robots at once.
template <class Real>
using Vector = Eigen::Matrix<Real, 3, 1>;
template <class Real>
using Matrix = Eigen::Matrix<Real, 3, 3>;

/// Velocity of the centre [m/s] and angular velocity [rad/s], in the world frame.
template <class Real>
struct MotionOf {
    Vector<Real> velocity;
    Vector<Real> spin;
};
using Motion = MotionOf<double>;

/// The pose and the motion of a body: the input of a step.
template <class Real>
struct BodyStateOf {
    Vector<Real> centre;       ///< [m]
    Matrix<Real> rotation;     ///< the same as `turn`
    std::array<Real, 4> turn;  ///< unit quaternion, scalar part first
    MotionOf<Real> motion;

    /// Moves the body for `step` [s], bit for bit as ODE does at the end of a step.
    void advance(const MotionOf<Real>& how, double step);
};
using BodyState = BodyStateOf<double>;

template <class Real>
void BodyStateOf<Real>::advance(const MotionOf<Real>& how, double step) {
    motion = how;
    const auto& [velocity, spin] = motion;
    centre += velocity * Real(step);
    const Vector<Real> along{turn[1], turn[2], turn[3]};
    const Vector<Real> turned = along + (spin * turn[0] + spin.cross(along)) * Real(step / 2);
    const Vector<Real> less = spin.cwiseProduct(along);
    Real w = turn[0] - (less.x() + less.y() + less.z()) * Real(step / 2);
    Real x = turned.x(), y = turned.y(), z = turned.z();
    // The formulas of dNormalize4 and dQtoR.
    const Real scale = 1 / root(w * w + x * x + y * y + z * z);
    turn = {w *= scale, x *= scale, y *= scale, z *= scale};
    const Real xx = 2 * x * x, yy = 2 * y * y, zz = 2 * z * z;
    rotation.row(0) << 1 - yy - zz, 2 * (x * y - w * z), 2 * (x * z + w * y);
    rotation.row(1) << 2 * (x * y + w * z), 1 - xx - zz, 2 * (y * z - w * x);
    rotation.row(2) << 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - xx - yy;
}

}  // namespace nezumi::sim
