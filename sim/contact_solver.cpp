// A step of `dWorldStep` finds velocities u and impulses p of the contacts with M (u - u_free) = J^T p and, for each
// row of J, either J u + s p = c and p within its bounds, or p at the bound that it would exceed; s = cfm / h (ODE's
// manual, "Constraint Force Mixing"). As s > 0, there is exactly one solution, and every method finds it. ODE pivots in
// a matrix with a row per equation (Dantzig's method). Here each equation is assumed to hold or to be at a bound, and
// wrong assumptions are corrected: all together (Newton's method for equations that are linear piece by piece), or,
// if that repeats without end, only the last one (Murty's method, which always ends).
//
// Equations are added one by one, as a Kalman filter adds measurements. So all matrices have the six rows of a body,
// and a firm contact (s near 0) costs no digits.
#include "sim/contact_solver.hpp"

#include <ode/odemath.h>

#include <algorithm>
#include <array>

namespace nezumi::sim {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;  // linear, then angular
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double firm_cfm = 1e-10;  // ODE's default, for friction without slip
// Of random states at walls, 99 % need at most two corrections.
constexpr int newton_rounds = 5, most_rounds = 50;

// All sums are written out, so that every processor adds in the same order.
double inner(const Vector6& a, const Vector6& b) {
    return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) + (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}
Vector6 times(const Matrix6& m, const Vector6& v) {
    return m.col(0) * v[0] + m.col(1) * v[1] + m.col(2) * v[2] + m.col(3) * v[3] + m.col(4) * v[4] + m.col(5) * v[5];
}

// A row of J, and what is assumed of it.
struct Equation {
    Vector6 row;
    double target;       // [m/s] c
    double softness;     // [1/kg] s
    double least, most;  // [N s] bounds of p
    bool holds;
    double impulse;  // [N s] p if the equation does not hold: one of the bounds

    // `wanted` is the impulse with which the equation would hold: assumes that it holds if this is within the bounds.
    void assume(double wanted) {
        impulse = std::clamp(wanted, least, most);
        holds = impulse == wanted;
    }
    // The impulse with which the equation would hold.
    double wanted(const Vector6& velocity) const { return (target - inner(row, velocity)) / softness; }
    // True if the velocities that follow from the assumption don't contradict it.
    bool agrees_with(const Vector6& velocity) const {
        const double p = wanted(velocity);
        return std::clamp(p, least, most) == (holds ? p : impulse);
    }
    // Reverses the assumption. An equation at one bound never goes directly to the other: for a firm equation that
    // would often be too far.
    void correct(const Vector6& velocity) {
        holds = !holds;
        impulse = std::clamp(wanted(velocity), least, most);
    }
};

// The velocities after a step with some of the equations, and what a unit impulse would add to them.
struct Response {
    Vector6 velocity;
    Matrix6 compliance;

    void add(Equation& equation, bool guess = false) {
        const Vector6 change = times(compliance, equation.row);
        const double share = 1 / (inner(equation.row, change) + equation.softness);
        const double impulse = (equation.target - inner(equation.row, velocity)) * share;
        if (guess) equation.assume(impulse);
        velocity += change * (equation.holds ? impulse : equation.impulse);
        if (equation.holds) compliance -= (change * share) * change.transpose();
    }
};

Response without_contacts(const RobotModel& model, const BodyState& body, double step) {
    Response free;
    free.velocity << body.motion.velocity, body.motion.spin;
    free.velocity[2] -= gravity * step;
    free.compliance.setZero();
    free.compliance.diagonal().head<3>().setConstant(1 / model.mass);
    for (int i = 0; i < 3; ++i) {
        const Vec3 axis = body.rotation.col(i);
        free.compliance.bottomRightCorner<3, 3>() += (axis * (1 / model.inertia[i])) * axis.transpose();
    }
    return free;
}

// Finds which of the equations hold. `response` includes the first `known` equations when this is called, and all of
// them afterwards. Returns false if it does not succeed.
bool settle(std::span<Equation> equations, std::size_t known, const Response& free, Response& response) {
    for (Equation& each : equations.subspan(known)) response.add(each, true);
    for (int round = 0; round < most_rounds; ++round) {
        Equation* wrong = nullptr;
        for (Equation& each : equations) {
            if (each.agrees_with(response.velocity)) continue;
            wrong = &each;
            if (round < newton_rounds) each.correct(response.velocity);
        }
        if (wrong == nullptr) return true;
        if (round >= newton_rounds) wrong->correct(response.velocity);
        response = free;
        for (Equation& each : equations) response.add(each);
    }
    return false;
}

}  // namespace

std::optional<Motion> solve_contacts(const RobotModel& model, const BodyState& body, std::span<const dContact> contacts,
                                     double step) {
    if (contacts.size() > most_solved_contacts) return {};
    std::array<Equation, 3 * most_solved_contacts> equations;
    std::size_t count = 0;
    const auto add = [&](const dContact& contact, const Vec3& along, double target, double cfm, double least,
                         double most) {
        const Vec3 arm = Eigen::Map<const Vec3>(contact.geom.pos) - body.centre;
        Vector6 row;
        row << along, arm.cross(along);
        equations[count++] = {row, target, cfm / step, least, most, true, 0};
    };
    const Response free = without_contacts(model, body, step);
    Response response = free;
    const auto settle_from = [&](std::size_t known) {
        return settle(std::span(equations).first(count), known, free, response);
    };

    for (const dContact& contact : contacts) {
        const double out = std::min(contact.surface.soft_erp * contact.geom.depth / step, correcting_speed);
        add(contact, Eigen::Map<const Vec3>(contact.geom.normal), out, contact.surface.soft_cfm, 0, dInfinity);
    }
    if (!settle_from(0)) return {};
    // ODE computes the limits of friction from the pressures without friction. The floor is the last of the contacts;
    // its softer friction first makes better guesses.
    for (std::size_t i = contacts.size(); i-- > 0;) {
        const auto& [surface, geom, first] = contacts[i];
        if (!equations[i].holds || surface.mu <= 0) continue;
        const double pressure = equations[i].wanted(response.velocity), limit = surface.mu * pressure;
        const auto has = [mode = surface.mode](int bit) { return (mode & bit) != 0; };
        const double limit_across = has(dContactMu2) ? surface.mu2 * pressure : limit;
        dVector3 plane, plane_across;
        if (!has(dContactFDir1)) dPlaneSpace(geom.normal, plane, plane_across);
        const Vec3 along = Eigen::Map<const Vec3>(has(dContactFDir1) ? first : plane);
        const Vec3 across = Eigen::Map<const Vec3>(geom.normal).cross(along);
        add(contacts[i], along, has(dContactMotion1) ? surface.motion1 : 0,
            has(dContactSlip1) ? surface.slip1 : firm_cfm, -limit, limit);
        add(contacts[i], across, 0, has(dContactSlip2) ? surface.slip2 : firm_cfm, -limit_across, limit_across);
    }
    if (!settle_from(contacts.size())) return {};
    return Motion{response.velocity.head<3>(), response.velocity.tail<3>()};
}

}  // namespace nezumi::sim
