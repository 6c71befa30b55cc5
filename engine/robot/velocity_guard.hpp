// Stands between velocity commands and wheels: finite, clamped, limited in acceleration, and stopped by silence.
#pragma once

#include "engine/ports/messages.hpp"
#include "engine/world/robot_spec.hpp"

namespace nezumi {

class VelocityGuard {
public:
    /// How long [s] a command holds when nothing follows it.
    static constexpr double timeout = 0.5;

    explicit VelocityGuard(Limits limits) : limits_(limits) {}

    /// What was done to a command.
    enum class Verdict { taken, clamped, not_finite };

    /// Takes a command that arrived at `now` [s]. One that is not finite counts as "stand still"; vy is ignored.
    Verdict command(const Velocity2D& velocity, double now);
    /// From now on: stand still.
    void stop() { target_ = {}; }

    /// The velocity to drive at `now` [s], `dt` [s] after the last call.
    Velocity2D advance(double now, double dt);

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
