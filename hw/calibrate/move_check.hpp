// Checks that each wheel, with the robot lifted, turns both ways and that its encoder counts.
#pragma once

#include <functional>
#include <string>

#include "hw/calibrate/guided_robot.hpp"
#include "hw/doctor/finding.hpp"

namespace nezumi::hw {

/// Assumes that a person already holds the robot; `tell` says which wheel turns next. Returns a finding for each wheel
/// and direction. Fails if the person ends the program.
Expected<Findings> check_moves(GuidedRobot& robot, const std::function<void(const std::string& text)>& tell);

}  // namespace nezumi::hw
