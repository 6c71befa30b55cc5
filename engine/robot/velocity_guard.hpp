// Checks velocity commands: finite, within limits, with limited acceleration, and zero after a time without commands.
#pragma once

#include "engine/ports/messages.hpp"
#include "engine/ports/port_base.hpp"
#include "engine/world/robot_spec.hpp"

namespace nezumi {

/// The rule: a robot that must slow down, or that speeds up, stays on the commanded arc, because the path was planned
/// around obstacles, but the speed was not. So a command beyond a limit is scaled as a whole, and axes that speed up do
/// it together, at the pace of the slower one. When braking, each axis uses its own full deceleration, because the
/// robot should be slow as soon as possible; on an arc one axis would have to wait for the other. An axis brakes if its
/// target is nearer to zero, or on the other side of zero (then it first brakes to zero, and speeds up from there). It
/// speeds up if its target is farther from zero on the same side. An axis does not wait for another axis that brakes.
class VelocityGuard {
public:
    /// The time [s] for which a command is valid without another one.
    static constexpr double timeout = silence;

    explicit VelocityGuard(Limits limits) : limits_(limits) {}

    /// The result of checking a command.
    enum class Verdict { taken, clamped, not_finite };

    /// Takes a command that arrived at `now` [s]. A command that is not finite means "stop"; vy is ignored.
    Verdict command(const Velocity2D& velocity, double now);
    /// Commands a stop.
    void stop() { target_ = {}; }
    /// Stops immediately, without a braking ramp.
    void halt() { target_ = current_ = {}; }

    /// The velocity at `now` [s]. Calls are `dt` [s] apart, and the last one was `passed` [s] ago: braking counts the
    /// time that has passed, but speeding up never more than `dt`.
    Velocity2D advance(double now, double dt, double passed);
    Velocity2D advance(double now, double dt) { return advance(now, dt, dt); }

    const Limits& limits() const { return limits_; }
    const Velocity2D& target() const { return target_; }
    const Velocity2D& current() const { return current_; }

private:
    Limits limits_;
    Velocity2D target_{};
    Velocity2D current_{};
    double commanded_at_ = 0;
};

}  // namespace nezumi
