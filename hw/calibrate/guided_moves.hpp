// Moves of a guided robot, measured by its own odometry.
#pragma once

#include "hw/calibrate/guided_robot.hpp"

namespace nezumi::hw {

/// Speeds of the moves, before the robot's limits apply.
struct Pace {
    double speed = 0.15;    ///< [m/s]
    double yaw_rate = 1.0;  ///< [rad/s]
};

/// Drives straight by `distance` [m], backwards if negative. Fails if the robot does not move.
Expected<void> go(GuidedRobot& robot, double distance, const Pace& pace, const GuidedRobot::EachTick& each_tick = {});
/// Turns by `angle` [rad], to the left if positive. Fails if the robot does not move.
Expected<void> turn(GuidedRobot& robot, double angle, const Pace& pace, const GuidedRobot::EachTick& each_tick = {});

}  // namespace nezumi::hw
