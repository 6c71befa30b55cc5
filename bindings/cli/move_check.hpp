// Each wheel both ways, with the robot in the air: do its counters, and the person who looks, see it turn?
#pragma once

#include "bindings/cli/guided_robot.hpp"
#include "bindings/cli/person.hpp"
#include "hw/doctor/finding.hpp"

namespace nezumi::cli {

/// Asks before anything moves. A finding for each wheel and direction; an error when the robot was asked to end.
Expected<hw::Findings> check_moves(GuidedRobot& robot, Person& person);

}  // namespace nezumi::cli
