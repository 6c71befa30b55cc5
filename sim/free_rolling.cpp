// With all bounds inactive a step of `dWorldStep` is linear: the forces f of the contacts and the velocities u after it
// satisfy M (u - u_free) = h J^T f and J u + cfm f = c (ODE's manual, "Constraint Force Mixing"). Without f that is
// (M + J^T S^-1 J) u = M u_free + J^T S^-1 c with S = cfm / h: six equations, however many contacts there are.
//
// In the frame of the heading (forward, left, up) each contact pushes along the axes only, so the equations of the
// three linear velocities are diagonal: what is left to solve has the size of the spin.
#include "sim/free_rolling.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace nezumi::sim {
namespace {

// A wheel that is lent less friction than this part of its limit grips.
constexpr double grips = 0.97;
// The cosine of a tilt that is no nodding any more.
constexpr double least_upright = 0.99;

// The axes in turn, each known to the compiler.
template <class Do>
void each_axis(Do&& act) {
    act.template operator()<0>();
    act.template operator()<1>();
    act.template operator()<2>();
}
constexpr int next(int axis) { return (axis + 1) % 3; }

// A symmetric matrix of three rows.
struct Symmetric {
    Rotation upper;

    double& at(int i, int j) { return upper(std::min(i, j), std::max(i, j)); }

    // Cholesky's decomposition without roots.
    Vec3 solve(const Vec3& right) const {
        const double xy = upper(0, 1) / upper(0, 0), xz = upper(0, 2) / upper(0, 0);
        const double y = upper(1, 1) - xy * upper(0, 1), off = upper(1, 2) - xz * upper(0, 1), yz = off / y;
        const double z = upper(2, 2) - xz * upper(0, 2) - yz * off;
        const double second = right.y() - xy * right.x(), third = right.z() - xz * right.x() - yz * second;
        const double c = third / z, b = second / y - yz * c;
        return {right.x() / upper(0, 0) - xy * b - xz * c, b, c};
    }
};

// Mass and contacts: A [linear; spin] = b. A contact along an axis turns about the other two only.
struct Equations {
    Vec3 linear;       // A's diagonal
    Rotation coupled;  // row: a linear velocity, column: a spin; none about its own axis
    Symmetric spin;
    Vec3 linear_right, spin_right;

    Motion solve() const {
        const Vec3 inverse = linear.cwiseInverse();
        Symmetric left = spin;
        Vec3 right = spin_right;
        each_axis([&]<int axis>() {
            constexpr int i = next(axis), j = next(i);
            const double to_i = coupled(axis, i) * inverse[axis], to_j = coupled(axis, j) * inverse[axis];
            left.at(i, i) -= to_i * coupled(axis, i);
            left.at(j, j) -= to_j * coupled(axis, j);
            left.at(i, j) -= to_i * coupled(axis, j);
            right[i] -= to_i * linear_right[axis];
            right[j] -= to_j * linear_right[axis];
        });
        const Vec3 turning = left.solve(right);
        return {(linear_right - coupled * turning).cwiseProduct(inverse), turning};
    }
};

// Holds the velocity of the contact at `arm` along an axis at `target` [m/s], softened by `cfm`.
template <int axis>
struct Equation {
    static constexpr int i = next(axis), j = next(i);
    Vec3 arm;
    double target;
    double cfm;

    void add_to(Equations& equations, double step) const {
        // `arm` cross the axis
        const double weight = step / cfm, about_i = arm[j], about_j = -arm[i];
        equations.linear[axis] += weight;
        equations.coupled(axis, i) += weight * about_i;
        equations.coupled(axis, j) += weight * about_j;
        equations.spin.at(i, i) += weight * about_i * about_i;
        equations.spin.at(j, j) += weight * about_j * about_j;
        equations.spin.at(i, j) += weight * about_i * about_j;
        equations.linear_right[axis] += weight * target;
        equations.spin_right[i] += weight * target * about_i;
        equations.spin_right[j] += weight * target * about_j;
    }
    double force(const Motion& motion) const {  // [N]
        return (target - motion.velocity[axis] - arm[j] * motion.spin[i] + arm[i] * motion.spin[j]) / cfm;
    }
};

}  // namespace

Supports supports_of(const RobotModel& model, const Vec3& centre, const Rotation& rotation) {
    Supports supports;
    // The lowest point of a wheel lies below its axle by `down`, the vertical within the wheel's plane.
    const Vec3 axis = rotation.col(1);
    const double flat = std::sqrt(std::max(0.0, 1 - axis.z() * axis.z()));
    supports.wheels_stand = flat > 0.3;
    const double scale = supports.wheels_stand ? 1 / flat : 1;
    supports.forward = {axis.y() * scale, -axis.x() * scale, 0};
    const Vec3 down = (axis * axis.z() - Vec3::UnitZ()) * (scale * model.wheel_radius);
    for (std::size_t i = 0; i < Supports::wheels; ++i)
        supports.at[i] = centre + rotate(rotation, model.wheels[i]) + down;
    for (std::size_t i = 0; i < model.skids.size(); ++i)
        supports.at[Supports::wheels + i] = centre + rotate(rotation, model.skids[i]);
    return supports;
}

std::optional<Motion> roll_freely(const RobotModel& model, const BodyState& body, const Wheels& speeds, double step) {
    const Vec3& centre = body.centre;
    const Rotation& rotation = body.rotation;
    if (rotation(2, 2) < least_upright) return {};
    if (centre.z() + rotation(2, 2) * model.hull_drop < model.hull.half_height_at(rotation)) return {};
    const Supports supports = supports_of(model, centre, rotation);

    const Vec3 &forward = supports.forward, left{-forward.y(), forward.x(), 0};
    const auto to_heading = [&](const Vec3& v) {
        return Vec3{forward.x() * v.x() + forward.y() * v.y(), left.x() * v.x() + left.y() * v.y(), v.z()};
    };
    const auto to_world = [&](const Vec3& v) {
        return Vec3{forward.x() * v.x() + left.x() * v.y(), forward.y() * v.x() + left.y() * v.y(), v.z()};
    };
    Rotation turned;
    for (int i = 0; i < 3; ++i) turned.col(i) = to_heading(rotation.col(i));

    Equations equations;
    equations.linear.setConstant(model.mass);
    equations.coupled.setZero();
    equations.spin.upper.noalias() = turned * model.inertia.asDiagonal() * turned.transpose();
    equations.linear_right = model.mass * (to_heading(body.motion.velocity) - Vec3{0, 0, gravity * step});
    equations.spin_right = equations.spin.upper * to_heading(body.motion.spin);

    std::array<Equation<2>, Supports::count> normals;
    for (std::size_t i = 0; i < Supports::count; ++i) {
        const double depth = -supports.at[i].z();
        if (!(depth > 0)) return {};
        const dSurfaceParameters& surface = (i < Supports::wheels ? model.wheel_contact : model.skid_contact).surface;
        normals[i] = {to_heading(supports.at[i] - centre), std::min(surface.soft_erp * depth / step, correcting_speed),
                      surface.soft_cfm};
        normals[i].add_to(equations, step);
    }
    // ODE takes the limits of friction from how the robot would stand without it.
    const Motion standing = equations.solve();
    const dSurfaceParameters& grip = model.wheel_contact.surface;
    const std::array<Equation<0>, Supports::wheels> along{
        {{normals[0].arm, speeds.left, grip.slip1}, {normals[1].arm, speeds.right, grip.slip1}}};
    const std::array<Equation<1>, Supports::wheels> across{
        {{normals[0].arm, 0, grip.slip2}, {normals[1].arm, 0, grip.slip2}}};
    for (const auto& each : along) each.add_to(equations, step);
    for (const auto& each : across) each.add_to(equations, step);
    const Motion rolling = equations.solve();

    for (const auto& normal : normals) {
        if (!(normal.force(rolling) >= 0)) return {};
    }
    for (std::size_t i = 0; i < Supports::wheels; ++i) {
        const double pressed = std::min(normals[i].force(rolling), normals[i].force(standing));
        const double lent = std::max(std::abs(along[i].force(rolling)), std::abs(across[i].force(rolling)));
        if (!(lent <= grips * grip.mu * pressed)) return {};
    }
    const Motion motion{to_world(rolling.velocity), to_world(rolling.spin)};
    if (!(motion.velocity.squaredNorm() < 1e6)) return {};
    return motion;
}

}  // namespace nezumi::sim
