// The safety rules for a velocity, the same in simulation and on hardware.
#include "engine/robot/velocity_guard.hpp"

#include <algorithm>
#include <cmath>

#include "engine/ports/payload.hpp"

namespace nezumi {

VelocityGuard::Verdict VelocityGuard::command(const Velocity2D& velocity, double now) {
    commanded_at_ = now;
    if (!is_finite(velocity)) {
        stop();
        return Verdict::not_finite;
    }
    target_ = {.vx = std::clamp(velocity.vx, -limits_.speed, limits_.speed),
               .vy = 0,
               .va = std::clamp(velocity.va, -limits_.yaw_rate, limits_.yaw_rate)};
    return target_.vx == velocity.vx && target_.va == velocity.va ? Verdict::taken : Verdict::clamped;
}

Velocity2D VelocityGuard::advance(double now, double dt) {
    constexpr double rounding = 1e-9;  // a command at 0.1 s has timed out at 0.6 s, however these were added up
    if (now - commanded_at_ >= timeout - rounding) stop();
    const auto approach = [](double from, double to, double most) { return from + std::clamp(to - from, -most, most); };
    current_.vx = approach(current_.vx, target_.vx, limits_.acceleration * dt);
    current_.va = approach(current_.va, target_.va, limits_.yaw_acceleration * dt);
    return current_;
}

}  // namespace nezumi
