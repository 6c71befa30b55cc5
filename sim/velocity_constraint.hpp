// Velocities forced on a robot from outside, as motors between it and the world.
#pragma once

#include "engine/world/world.hpp"
#include "sim/ode_library.hpp"

namespace nezumi::sim {

struct SimRobot;

/// Empty, or the motors that hold a robot at the velocities of a `Push`. Must not outlive its world.
class VelocityConstraint {
public:
    VelocityConstraint() = default;
    /// Of the robot as it stands now: the axes then turn with it.
    VelocityConstraint(dWorldID world, const SimRobot& robot, const Push& push);

    explicit operator bool() const { return linear_ || angular_; }

private:
    void hold_linear(dWorldID world, const SimRobot& robot, const Push& push);
    void hold_angular(dWorldID world, const SimRobot& robot, const Push& push);

    JointHandle linear_, angular_;
};

}  // namespace nezumi::sim
