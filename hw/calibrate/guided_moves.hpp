// Moves of a guided robot by its own odometry.
#pragma once

#include "hw/calibrate/guided_robot.hpp"

namespace nezumi::hw {

/// How fast it moves, before its limits.
struct Pace {
    double speed = 0.15;    ///< [m/s]
    double yaw_rate = 1.0;  ///< [rad/s]
};

/// Straight on by so much [m], backwards when it is negative. An error when it does not move.
Expected<void> go(GuidedRobot& robot, double distance, const Pace& pace, const GuidedRobot::EachTick& each_tick = {});
/// Turns by so much [rad], to the left when it is positive. An error when it does not move.
Expected<void> turn(GuidedRobot& robot, double angle, const Pace& pace, const GuidedRobot::EachTick& each_tick = {});

}  // namespace nezumi::hw
