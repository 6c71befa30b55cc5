// Stands between velocity commands and wheels: finite, clamped, limited in acceleration, and stopped by silence.
#pragma once

#include "engine/ports/messages.hpp"
#include "engine/ports/port_base.hpp"
#include "engine/world/robot_spec.hpp"

namespace nezumi {

/// The rule. A robot that slows down because it must, or gets up to speed, stays on the arc that it was told: its path
/// is what was planned around obstacles, its speed is not. So a command beyond a limit is scaled as a whole, and axes
/// that speed up do it together, at the pace of the slower one. Braking is each axis at its own full deceleration: who
/// brakes wants to stand, or at least to be slower, as soon as can be, and an arc kept would make one axis wait for the
/// other. An axis brakes when its target is nearer to zero or on the other side of it (then to zero first, and speeds
/// up from there); it speeds up when its target is farther from zero on its own side. While one axis brakes the other
/// does not wait for it.
class VelocityGuard {
public:
    /// How long [s] a command holds when nothing follows it.
    static constexpr double timeout = silence;

    explicit VelocityGuard(Limits limits) : limits_(limits) {}

    /// What was done to a command.
    enum class Verdict { taken, clamped, not_finite };

    /// Takes a command that arrived at `now` [s]. One that is not finite counts as "stand still"; vy is ignored.
    Verdict command(const Velocity2D& velocity, double now);
    /// From now on: stand still.
    void stop() { target_ = {}; }
    /// Stands still now, without braking.
    void halt() { target_ = current_ = {}; }

    /// The velocity to drive at `now` [s], when calls are `dt` [s] apart and the last one was `passed` [s] ago: that is
    /// what it has braked for since, while it never speeds up by more than a `dt` gives.
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
