// Velocities forced on a robot from outside, by ODE motors between the robot and the world.
#pragma once

#include "engine/world/world.hpp"
#include "sim/ode_library.hpp"

namespace nezumi::sim {

struct SimRobot;

/// The motors that hold a robot at the velocities of a `VelocityConstraint`, or none. Must not outlive its world.
class ConstraintMotors {
public:
    ConstraintMotors() = default;
    /// Uses the present heading of the robot; from then on the axes turn with it.
    ConstraintMotors(dWorldID world, const SimRobot& robot, const VelocityConstraint& constraint);

    explicit operator bool() const { return linear_ || angular_; }

private:
    void hold_linear(dWorldID world, const SimRobot& robot, const VelocityConstraint& constraint);
    void hold_angular(dWorldID world, const SimRobot& robot, const VelocityConstraint& constraint);

    JointHandle linear_, angular_;
};

}  // namespace nezumi::sim
