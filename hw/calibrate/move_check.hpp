// Each wheel both ways, with the robot in the air: do its counters, and the person who looks, see it turn?
#pragma once

#include <functional>
#include <string>

#include "hw/calibrate/guided_robot.hpp"
#include "hw/doctor/finding.hpp"

namespace nezumi::hw {

/// The person who holds the robot has been asked before, and is told which wheel turns. A finding for each wheel and
/// direction; an error when the robot was asked to end.
Expected<Findings> check_moves(GuidedRobot& robot, const std::function<void(const std::string& text)>& tell);

}  // namespace nezumi::hw
