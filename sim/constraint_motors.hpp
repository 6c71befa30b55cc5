// Velocities forced on a robot from outside, as motors between it and the world.
#pragma once

#include "engine/world/world.hpp"
#include "sim/ode_library.hpp"

namespace nezumi::sim {

struct SimRobot;

/// Empty, or the motors that hold a robot at the velocities of a `VelocityConstraint`. Must not outlive its world.
class ConstraintMotors {
public:
    ConstraintMotors() = default;
    /// Of the robot as it stands now: the axes then turn with it.
    ConstraintMotors(dWorldID world, const SimRobot& robot, const VelocityConstraint& constraint);

    explicit operator bool() const { return linear_ || angular_; }

private:
    void hold_linear(dWorldID world, const SimRobot& robot, const VelocityConstraint& constraint);
    void hold_angular(dWorldID world, const SimRobot& robot, const VelocityConstraint& constraint);

    JointHandle linear_, angular_;
};

}  // namespace nezumi::sim
