// With all bounds inactive a step of `dWorldStep` is linear: the forces f of the contacts and the velocities u after it
// satisfy M (u - u_free) = h J^T f and J u + cfm f = c (ODE's manual, "Constraint Force Mixing"). Without f that is
// (M + J^T S^-1 J) u = M u_free + J^T S^-1 c with S = cfm / h: six equations, however many contacts there are.
//
// In the frame of the heading (forward, left, up) each contact pushes along the axes only, so the equations of the
// three linear velocities are diagonal: what is left to solve has the size of the spin.
#include "sim/free_rolling.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "sim/lanes.hpp"

namespace nezumi::sim {
namespace {

template <class Real>
using Holds = decltype(Real() > Real());

// Sums a row of a product in the order that Eigen uses for doubles. Eigen would use another order for lanes, which
// gives other bits.
template <class Real>
Real sum_of_row(int row, Real a, Real b, Real c) {
    return row < 2 ? (a + b) + c : a + (b + c);
}

template <class Real>
Vector<Real> product(const Matrix<Real>& m, const Vector<Real>& v) {
    Vector<Real> all;
    for (int i = 0; i < 3; ++i) all[i] = sum_of_row<Real>(i, m(i, 0) * v[0], m(i, 1) * v[1], m(i, 2) * v[2]);
    return all;
}

// The inertia tensor in the outer frame of a body with this rotation.
template <class Real>
Matrix<Real> turn_inertia(const Vec3& own, const Matrix<Real>& turned) {
    Matrix<Real> all;
    for (int i = 0; i < 3; ++i) {
        const Real a = turned(i, 0) * Real(own[0]), b = turned(i, 1) * Real(own[1]), c = turned(i, 2) * Real(own[2]);
        for (int j = 0; j < 3; ++j)
            all(i, j) = sum_of_row<Real>(i, a * turned(j, 0), b * turned(j, 1), c * turned(j, 2));
    }
    return all;
}

template <class Real>
Real square(const Vector<Real>& v) {
    return v.x() * v.x() + v.y() * v.y() + v.z() * v.z();
}

// A wheel that uses less than this part of its friction limit does not slip.
constexpr double grips = 0.97;
// The cosine of the tilt above which a robot no longer stands on its wheels.
constexpr double least_upright = 0.99;

// Calls `Do` for each axis, as a compile-time constant.
template <int... axes, class Do>
void each_axis(Do&& act) {
    (act.template operator()<axes>(), ...);
}
constexpr int next(int axis) { return (axis + 1) % 3; }

// A symmetric 3 x 3 matrix.
template <class Real>
struct Symmetric {
    Matrix<Real> upper;

    Real& at(int i, int j) { return upper(std::min(i, j), std::max(i, j)); }

    // Cholesky decomposition without square roots (LDL^T).
    Vector<Real> solve(const Vector<Real>& right) const {
        const Real xy = upper(0, 1) / upper(0, 0), xz = upper(0, 2) / upper(0, 0);
        const Real y = upper(1, 1) - xy * upper(0, 1), off = upper(1, 2) - xz * upper(0, 1), yz = off / y;
        const Real z = upper(2, 2) - xz * upper(0, 2) - yz * off;
        const Real second = right.y() - xy * right.x(), third = right.z() - xz * right.x() - yz * second;
        const Real c = third / z, b = second / y - yz * c;
        return {right.x() / upper(0, 0) - xy * b - xz * c, b, c};
    }
};

// Mass and contacts: A [linear; spin] = b. A contact along an axis gives torques about the other two axes only.
template <class Real>
struct Equations {
    Vector<Real> linear;   // A's diagonal
    Matrix<Real> coupled;  // row: linear velocity; column: spin. The diagonal is empty: a force gives no torque about
                           // its own axis
    Symmetric<Real> spin;
    Vector<Real> linear_right, spin_right;

    // `axes` are those whose velocities are coupled to spins.
    template <int... axes>
    MotionOf<Real> solve() const {
        const Vector<Real> inverse = linear.cwiseInverse();
        Symmetric<Real> left = spin;
        Vector<Real> right = spin_right;
        each_axis<axes...>([&]<int axis>() {
            constexpr int i = next(axis), j = next(i);
            const Real to_i = coupled(axis, i) * inverse[axis], to_j = coupled(axis, j) * inverse[axis];
            left.at(i, i) -= to_i * coupled(axis, i);
            left.at(j, j) -= to_j * coupled(axis, j);
            left.at(i, j) -= to_i * coupled(axis, j);
            right[i] -= to_i * linear_right[axis];
            right[j] -= to_j * linear_right[axis];
        });
        const Vector<Real> turning = left.solve(right);
        return {(linear_right - product(coupled, turning)).cwiseProduct(inverse), turning};
    }
};

// Holds the velocity of the contact at `arm` along an axis at `target` [m/s], with softness.
template <int axis, class Real>
struct Equation {
    static constexpr int i = next(axis), j = next(i);
    Vector<Real> arm;
    Real target;
    SoftEquation soft;

    void add_to(Equations<Real>& equations) const {
        // `arm` x axis
        const Real weight = soft.weight, about_i = arm[j], about_j = -arm[i];
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
    Real force(const MotionOf<Real>& motion) const {  // [N]
        return (target - motion.velocity[axis] - arm[j] * motion.spin[i] + arm[i] * motion.spin[j]) * Real(soft.force);
    }
};

template <class Real>
struct SupportsOf {
    std::array<Vector<Real>, Supports::count> at;
    Vector<Real> forward;
    Holds<Real> wheels_stand;
};

// Uses the formula of geometry.hpp.
template <class Real>
Vector<Real> turned_by(const Matrix<Real>& r, const Vec3& v) {
    return r.col(0) * Real(v.x()) + r.col(1) * Real(v.y()) + r.col(2) * Real(v.z());
}

template <class Real>
SupportsOf<Real> find_supports(const RobotModel& model, const Vector<Real>& centre, const Matrix<Real>& rotation) {
    SupportsOf<Real> supports;
    // The lowest point of a wheel is `down` below its axle: the vertical, projected into the plane of the wheel.
    const Vector<Real> axis = rotation.col(1);
    const Real flat = root(greater(Real(0.0), 1 - axis.z() * axis.z()));
    supports.wheels_stand = flat > Real(0.3);
    const Real scale = choose(supports.wheels_stand, 1 / flat, Real(1));
    supports.forward = {axis.y() * scale, -axis.x() * scale, Real(0)};
    const Vector<Real> down = (axis * axis.z() - Vector<Real>::UnitZ()) * (scale * model.wheel_radius);
    for (std::size_t i = 0; i < Supports::wheels; ++i)
        supports.at[i] = centre + turned_by(rotation, model.wheels[i]) + down;
    for (std::size_t i = 0; i < model.skids.size(); ++i)
        supports.at[Supports::wheels + i] = centre + turned_by(rotation, model.skids[i]);
    return supports;
}

// True if the robot stands upright on wheels and skids and its hull is off the floor.
template <class Real>
Holds<Real> stands(const RobotModel& model, const BodyStateOf<Real>& body) {
    const Real upright = body.rotation(2, 2);
    const Real bottom = body.centre.z() + upright * model.hull_drop - model.hull.half_height_at(body.rotation);
    return both(upright >= Real(least_upright), bottom >= Real(0));
}

// True if standing robots of this model roll freely; then `to` is their motion.
template <class Real>
Holds<Real> roll(const RobotModel& model, const BodyStateOf<Real>& body, const std::array<Real, 2>& speeds, double step,
                 MotionOf<Real>& to) {
    const auto& [centre, rotation, turn, before] = body;
    const SupportsOf<Real> supports = find_supports(model, centre, rotation);

    const Vector<Real>&forward = supports.forward, left{-forward.y(), forward.x(), Real(0)};
    const auto to_heading = [&](const Vector<Real>& v) {
        return Vector<Real>{forward.x() * v.x() + forward.y() * v.y(), left.x() * v.x() + left.y() * v.y(), v.z()};
    };
    const auto to_world = [&](const Vector<Real>& v) {
        return Vector<Real>{forward.x() * v.x() + left.x() * v.y(), forward.y() * v.x() + left.y() * v.y(), v.z()};
    };
    Matrix<Real> turned;
    for (int i = 0; i < 3; ++i) turned.col(i) = to_heading(rotation.col(i));

    Equations<Real> equations;
    equations.linear.setConstant(Real(model.mass));
    equations.coupled.setZero();
    equations.spin.upper = turn_inertia(model.inertia, turned);
    equations.linear_right =
        Real(model.mass) * (to_heading(before.velocity) - Vector<Real>{Real(0), Real(0), Real(gravity * step)});
    equations.spin_right = product<Real>(equations.spin.upper, to_heading(before.spin));

    std::array<Equation<2, Real>, Supports::count> normals;
    Holds<Real> rolls = Real(0) <= Real(0);
    for (std::size_t i = 0; i < Supports::count; ++i) {
        const Real depth = -supports.at[i].z();
        rolls = both(rolls, depth > Real(0));
        const bool is_wheel = i < Supports::wheels;
        const double erp = (is_wheel ? model.wheel_contact : model.skid_contact).surface.soft_erp;
        normals[i] = {to_heading(supports.at[i] - centre), lesser(erp * depth / step, Real(correcting_speed)),
                      is_wheel ? model.wheel_normal : model.skid_normal};
        normals[i].add_to(equations);
    }
    // ODE computes the friction limits from the forces of the same step without friction.
    const MotionOf<Real> standing = equations.template solve<2>();
    const std::array<Equation<0, Real>, Supports::wheels> along{
        {{normals[0].arm, speeds[0], model.wheel_along}, {normals[1].arm, speeds[1], model.wheel_along}}};
    const std::array<Equation<1, Real>, Supports::wheels> across{
        {{normals[0].arm, Real(0), model.wheel_across}, {normals[1].arm, Real(0), model.wheel_across}}};
    for (const auto& each : along) each.add_to(equations);
    for (const auto& each : across) each.add_to(equations);
    const MotionOf<Real> rolling = equations.template solve<0, 1, 2>();

    for (const auto& normal : normals) rolls = both(rolls, normal.force(rolling) >= Real(0));
    for (std::size_t i = 0; i < Supports::wheels; ++i) {
        const Real pressed = lesser(normals[i].force(rolling), normals[i].force(standing));
        const Real lent = greater(magnitude(along[i].force(rolling)), magnitude(across[i].force(rolling)));
        rolls = both(rolls, lent <= grips * model.wheel_contact.surface.mu * pressed);
    }
    to = {to_world(rolling.velocity), to_world(rolling.spin)};
    return both(rolls, square(to.velocity) < Real(1e6));
}

// Robots of one model. `rolling` tells which of them have rolled freely in all steps.
template <class Real>
void take_steps(const RobotModel& model, BodyStateOf<Real>& body, const std::array<Real, 2>& speeds, double step,
                std::span<double> fastest, Holds<Real>& rolling) {
    rolling = Real(0) <= Real(0);
    for (double& most : fastest) {
        MotionOf<Real> motion;
        rolling = both(rolling, both(stands(model, body), roll(model, body, speeds, step, motion)));
        if (!any(rolling)) return;
        body.advance(motion, step);
        most = std::max(most, largest(choose(rolling, square(motion.velocity), Real(0.0))));
    }
}

// Inlined completely, so that all of it is compiled for the chosen processor.
struct AnyProcessor {
    [[gnu::flatten]] static void take_steps_side_by_side(const RobotModel& model, BodyStateOf<Lanes>& body,
                                                         const std::array<Lanes, 2>& speeds, double step,
                                                         std::span<double> fastest, LaneMask& rolling) {
        take_steps(model, body, speeds, step, fastest, rolling);
    }
    [[gnu::flatten]] static void take_steps_alone(const RobotModel& model, BodyState& body,
                                                  const std::array<double, 2>& speeds, double step,
                                                  std::span<double> fastest, bool& rolling) {
        take_steps(model, body, speeds, step, fastest, rolling);
    }
    [[gnu::flatten]] static bool roll_alone(const RobotModel& model, const BodyState& body,
                                            const std::array<double, 2>& speeds, double step, Motion& to) {
        return stands(model, body) && roll(model, body, speeds, step, to);
    }
};

#if defined(__x86_64__)
// The operations with AVX2, four numbers at a time and with three operands. They give the same bits.
struct Avx2 {
    [[gnu::flatten, gnu::target("avx2")]] static void take_steps_side_by_side(const RobotModel& model,
                                                                              BodyStateOf<Lanes>& body,
                                                                              const std::array<Lanes, 2>& speeds,
                                                                              double step, std::span<double> fastest,
                                                                              LaneMask& rolling) {
        take_steps(model, body, speeds, step, fastest, rolling);
    }
    [[gnu::flatten, gnu::target("avx2")]] static void take_steps_alone(const RobotModel& model, BodyState& body,
                                                                       const std::array<double, 2>& speeds, double step,
                                                                       std::span<double> fastest, bool& rolling) {
        take_steps(model, body, speeds, step, fastest, rolling);
    }
    [[gnu::flatten, gnu::target("avx2")]] static bool roll_alone(const RobotModel& model, const BodyState& body,
                                                                 const std::array<double, 2>& speeds, double step,
                                                                 Motion& to) {
        return stands(model, body) && roll(model, body, speeds, step, to);
    }
};
#define NEZUMI_HERE(function) (__builtin_cpu_supports("avx2") ? Avx2::function : AnyProcessor::function)
#else
#define NEZUMI_HERE(function) AnyProcessor::function
#endif
const auto take_steps_side_by_side = NEZUMI_HERE(take_steps_side_by_side);
const auto take_steps_alone = NEZUMI_HERE(take_steps_alone);
const auto roll_alone = NEZUMI_HERE(roll_alone);

// Calls `act(number, its lanes)` for all numbers that a step changes.
template <class Do>
void each_number(BodyState& body, BodyStateOf<Lanes>& lanes, const Do& act) {
    for (int i = 0; i < 3; ++i) {
        act(body.centre[i], lanes.centre[i]);
        act(body.motion.velocity[i], lanes.motion.velocity[i]);
        act(body.motion.spin[i], lanes.motion.spin[i]);
        for (int j = 0; j < 3; ++j) act(body.rotation(i, j), lanes.rotation(i, j));
    }
    for (std::size_t i = 0; i < body.turn.size(); ++i) act(body.turn[i], lanes.turn[i]);
}

}  // namespace

Supports supports_of(const RobotModel& model, const Vec3& centre, const Rotation& rotation) {
    const SupportsOf<double> found = find_supports(model, centre, rotation);
    return {found.at, found.forward, found.wheels_stand};
}

std::optional<Motion> roll_freely(const RobotModel& model, const BodyState& body, const Wheels& speeds, double step) {
    Motion motion;
    if (!roll_alone(model, body, {speeds.left, speeds.right}, step, motion)) return {};
    return motion;
}

void roll_freely(const RobotModel& model, std::span<Rolling> robots, double step, std::span<double> fastest) {
    assert(!robots.empty() && robots.size() <= Lanes::count);
    if (robots.size() == 1) {
        auto& [body, its_speeds, rolls] = robots.front();
        take_steps_alone(model, body, {its_speeds.left, its_speeds.right}, step, fastest, rolls);
        return;
    }
    BodyStateOf<Lanes> bodies;
    std::array<Lanes, 2> speeds;
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
        auto& [body, its_speeds, rolls] = robots[std::min(lane, robots.size() - 1)];
        each_number(body, bodies, [lane](double number, Lanes& lanes) { lanes.set(lane, number); });
        speeds[0].set(lane, its_speeds.left);
        speeds[1].set(lane, its_speeds.right);
    }
    LaneMask rolling;
    take_steps_side_by_side(model, bodies, speeds, step, fastest, rolling);
    for (std::size_t lane = 0; lane < robots.size(); ++lane) {
        auto& [body, its_speeds, rolls] = robots[lane];
        rolls = rolling[lane];
        each_number(body, bodies, [lane](double& number, const Lanes& lanes) { number = lanes[lane]; });
    }
}

}  // namespace nezumi::sim
