// A linear and an angular motor of ODE that force velocities.
#include "sim/constraint_motors.hpp"

#include "sim/bodies.hpp"

namespace nezumi::sim {
namespace {

// Motor force [N]: stronger than the wheels' grip, but too weak to press a robot into a wall.
double strength(const RobotModel& model) { return 3 * model.mass * gravity; }

}  // namespace

ConstraintMotors::ConstraintMotors(dWorldID world, const SimRobot& robot, const VelocityConstraint& constraint) {
    if (constraint.vx || constraint.vy) hold_linear(world, robot, constraint);
    if (constraint.vx || constraint.vy || constraint.va) hold_angular(world, robot, constraint);
}

void ConstraintMotors::hold_linear(dWorldID world, const SimRobot& robot, const VelocityConstraint& constraint) {
    linear_ = JointHandle(dJointCreateLMotor(world, nullptr));
    const dJointID motor = linear_.get();
    dJointAttach(motor, robot.body.id, nullptr);
    dJointSetLMotorNumAxes(motor, constraint.vx && constraint.vy ? 2 : 1);
    const Rotation r = robot.body.rotation();
    const Vec3 first = r.col(constraint.vx ? 0 : 1);
    const double force = strength(*robot.model);
    // `1`: the axis is relative to the robot's body.
    dJointSetLMotorAxis(motor, 0, 1, first.x(), first.y(), first.z());
    // The constraint is for the origin of the body frame, but the motor acts at the hull's centre.
    const double side = constraint.va.value_or(0) * -robot.model->origin.x();
    dJointSetLMotorParam(motor, dParamVel, constraint.vx ? *constraint.vx : *constraint.vy + side);
    dJointSetLMotorParam(motor, dParamFMax, force);
    if (constraint.vx && constraint.vy) {
        dJointSetLMotorAxis(motor, 1, 1, r(0, 1), r(1, 1), r(2, 1));
        dJointSetLMotorParam(motor, dParamVel2, *constraint.vy + side);
        dJointSetLMotorParam(motor, dParamFMax2, force);
    }
}

void ConstraintMotors::hold_angular(dWorldID world, const SimRobot& robot, const VelocityConstraint& constraint) {
    angular_ = JointHandle(dJointCreateAMotor(world, nullptr));
    const dJointID motor = angular_.get();
    dJointAttach(motor, robot.body.id, nullptr);
    dJointSetAMotorNumAxes(motor, 3);
    // Roll and pitch are held as well. Otherwise the grip of the wheels would tip the robot.
    const Rotation r = robot.body.rotation();
    const double torque = strength(*robot.model) * robot.model->spec->drive.track;
    dJointSetAMotorAxis(motor, 0, 1, r(0, 0), r(1, 0), r(2, 0));
    dJointSetAMotorAxis(motor, 1, 1, r(0, 1), r(1, 1), r(2, 1));
    dJointSetAMotorAxis(motor, 2, 0, 0, 0, 1);
    dJointSetAMotorParam(motor, dParamFMax, torque);
    dJointSetAMotorParam(motor, dParamFMax2, torque);
    if (constraint.va) {
        dJointSetAMotorParam(motor, dParamVel3, *constraint.va);
        dJointSetAMotorParam(motor, dParamFMax3, torque);
    }
}

}  // namespace nezumi::sim
