// The drives that calibrate a robot's wheels, and the measured end of each.
#pragma once

#include <functional>
#include <string>

#include "engine/robot/wheel_fit.hpp"
#include "hw/calibrate/guided_robot.hpp"

namespace nezumi::hw {

struct OdometryCourse {
    double side = 0.5;      ///< [m] side of the squares; the straight drive is twice as long
    double speed = 0.15;    ///< [m/s], reduced to the robot's limits
    double yaw_rate = 1.0;  ///< [rad/s]
};

/// `place` is called before each drive. `measure` is called after it, and returns the position [m] in the frame of the
/// start.
struct CourseHelp {
    std::function<Expected<void>(const std::string& drive)> place;
    std::function<Expected<Point2D>(const std::string& drive)> measure;
};

/// Drives straight, a square to the left and one to the right, each after a call of `place`, and fits the wheel
/// parameters to the measured ends. Errors as of `fit_wheels`, or if the robot does not move or the person ends the
/// program.
Expected<WheelFit> calibrate_odometry(GuidedRobot& robot, const OdometryCourse& course, const CourseHelp& help);

/// The wheel parameters that the odometry uses.
WheelCalibration wheels_of(const DriveSpec& drive);

}  // namespace nezumi::hw
