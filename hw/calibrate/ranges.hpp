// What a robot's range sensors say of a wall, at distances that its odometry knows.
#pragma once

#include <vector>

#include "engine/world/calibration.hpp"
#include "hw/calibrate/guided_robot.hpp"

namespace nezumi::hw {

struct RangeCourse {
    double wall = 0.1;      ///< [m] from the middle of the wheels' axis to the wall, which the robot faces squarely
    double settling = 0.3;  ///< [s] for which it stands before its sensors are believed
    double looking = 0.5;   ///< [s] over which they are averaged
};

/// Backs away from the wall, stops at one distance after the other, turns so that sensors that look aside see it
/// squarely as well, and gives what they say. Sensors that look more than 60 degrees aside are left out. An error when
/// none is left, or when one says too little.
Expected<std::vector<RangeCalibration>> calibrate_ranges(GuidedRobot& robot, const RangeCourse& course);

}  // namespace nezumi::hw
