// Measures a robot's range sensors in front of a wall at distances known from odometry.
#pragma once

#include <vector>

#include "engine/world/calibration.hpp"
#include "hw/calibrate/guided_robot.hpp"

namespace nezumi::hw {

struct RangeCourse {
    double wall = 0.1;      ///< [m] from the middle of the axle to the wall; the robot faces the wall at a right angle
    double settling = 0.3;  ///< [s] of standstill before readings count
    double looking = 0.5;   ///< [s] over which readings are averaged
};

/// Backs away from the wall and stops at one distance after the other. Turns the robot so that sensors that are mounted
/// at an angle face the wall at a right angle too. Returns the mean readings. Sensors at more than 60 degrees are left
/// out. Fails if none is left, or if a sensor gives too few readings.
Expected<std::vector<RangeCalibration>> calibrate_ranges(GuidedRobot& robot, const RangeCourse& course);

}  // namespace nezumi::hw
