// The step of a robot that touches only fixed things: the same result as ODE's solver.
#pragma once

#include <ode/contact.h>

#include <optional>
#include <span>

#include "sim/body_state.hpp"
#include "sim/robot_model.hpp"

namespace nezumi::sim {

/// The largest number of contacts; with more, ODE computes the step.
inline constexpr std::size_t most_solved_contacts = 16;

/// Returns the robot's velocities after a step of `step` [s] with these contacts, all of them between the robot and
/// fixed things. It solves the problem that `dWorldStep` sets up, with the bounds of pressure and friction. Returns
/// nothing if there are too many contacts, or if it was not found which bounds are active.
std::optional<Motion> solve_contacts(const RobotModel& model, const BodyState& body, std::span<const dContact> contacts,
                                     double step);

}  // namespace nezumi::sim
