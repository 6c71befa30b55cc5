// The drives that calibrate a robot's wheels, and where they ended.
#pragma once

#include <functional>
#include <string>

#include "engine/robot/wheel_fit.hpp"
#include "hw/calibrate/guided_robot.hpp"

namespace nezumi::hw {

struct OdometryCourse {
    double side = 0.5;      ///< [m] of the squares; the straight drive is twice as long
    double speed = 0.15;    ///< [m/s], at most what the robot's limits allow
    double yaw_rate = 1.0;  ///< [rad/s]
};

/// Told before a drive, asked after it: where the robot stands in the frame of its start [m].
struct CourseHelp {
    std::function<Expected<void>(const std::string& drive)> place;
    std::function<Expected<Point2D>(const std::string& drive)> measure;
};

/// Drives straight, a square to the left and one to the right, each from where `place` says, and fits the wheels to the
/// measured ends. Errors as of `fit_wheels`, or when the robot was asked to end or does not move.
Expected<WheelFit> calibrate_odometry(GuidedRobot& robot, const OdometryCourse& course, const CourseHelp& help);

/// The wheels that the robot's odometry reckons with.
WheelCalibration wheels_of(const DriveSpec& drive);

}  // namespace nezumi::hw
