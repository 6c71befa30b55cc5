// The safety rules for velocity commands, the same in simulation and on hardware.
#include "engine/robot/velocity_guard.hpp"

#include <algorithm>
#include <cmath>

namespace nezumi {
namespace {

// True if an axis at `from` brakes on its way to `to`.
bool brakes(double from, double to) { return from * to < 0 || std::abs(to) < std::abs(from); }

// Moves towards `to` by at most `most`, but not beyond zero.
double brake(double from, double to, double most) {
    const double end = from * to > 0 ? to : 0;
    return std::abs(end - from) <= most ? end : from + std::copysign(most, end - from);
}

}  // namespace

VelocityGuard::Verdict VelocityGuard::command(const Velocity2D& velocity, double now) {
    commanded_at_ = now;
    bool finite = true;  // runs in each tick, so without a walk over the type's table
    for_each_field(velocity, [&](const auto&, double speed) { finite = finite && std::isfinite(speed); });
    if (!finite) {
        stop();
        return Verdict::not_finite;
    }
    const double part =
        std::min({1.0, limits_.speed / std::abs(velocity.vx), limits_.yaw_rate / std::abs(velocity.va)});
    target_ = {.vx = std::clamp(velocity.vx * part, -limits_.speed, limits_.speed),
               .vy = 0,
               .va = std::clamp(velocity.va * part, -limits_.yaw_rate, limits_.yaw_rate)};
    return part == 1 ? Verdict::taken : Verdict::clamped;
}

Velocity2D VelocityGuard::advance(double now, double dt, double passed) {
    constexpr double rounding = 1e-9;  // a command at 0.1 s times out at 0.6 s, independent of rounding
    if (now - commanded_at_ >= timeout - rounding) stop();

    struct Axis {
        double& current;
        double target;
        double acceleration;
        bool braking;
    };
    Axis axes[] = {{current_.vx, target_.vx, limits_.acceleration, brakes(current_.vx, target_.vx)},
                   {current_.va, target_.va, limits_.yaw_acceleration, brakes(current_.va, target_.va)}};
    double part = 1;  // part of the way to their targets for axes that accelerate
    for (const Axis& axis : axes) {
        const double way = std::abs(axis.target - axis.current), most = axis.acceleration * dt;
        if (!axis.braking && way > most) part = std::min(part, most / way);
    }
    for (const Axis& axis : axes) {
        if (axis.braking) {
            axis.current = brake(axis.current, axis.target, axis.acceleration * passed);
        } else {
            axis.current = part < 1 ? axis.current + part * (axis.target - axis.current) : axis.target;
        }
    }
    return current_;
}

}  // namespace nezumi
