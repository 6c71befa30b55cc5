// The step of a robot that touches only the flat floor, in closed form: the same result as ODE's solver.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "engine/world/world.hpp"
#include "sim/bodies.hpp"

namespace nezumi::sim {

/// The lowest points of a robot's wheels and skids.
struct Supports {
    static constexpr std::size_t wheels = 2, count = 4;
    std::array<Vec3, count>
        at;             ///< [m] left and right wheel, front and rear skid; below the floor means that it carries load
    Vec3 forward;       ///< horizontal rolling direction of both wheels
    bool wheels_stand;  ///< the wheels are upright enough to touch the floor with their rims
};
Supports supports_of(const RobotModel& model, const Vec3& centre, const Rotation& rotation);

/// Returns the robot's velocities after a step of `step` [s] with these wheel speeds [m/s]. It solves the equations
/// that `dWorldStep` sets up for springs, motors and friction, while none of their bounds is active. Returns nothing if
/// a bound may be active: a support that would be pulled, a wheel that may slip, a hull that may touch the floor.
std::optional<Motion> roll_freely(const RobotModel& model, const BodyState& body, const Wheels& speeds, double step);

/// A robot that takes several steps.
struct Rolling {
    BodyState body;
    Wheels speeds;      ///< [m/s]
    bool rolls = true;  ///< it rolled freely in every step; if false, `body` is not valid afterwards
};
/// Advances at most `Lanes::count` robots of one model by `fastest.size()` steps, bit for bit as above. Raises each
/// element of `fastest` to the largest squared speed [m^2/s^2] after that step, of the robots that have rolled freely
/// so far.
void roll_freely(const RobotModel& model, std::span<Rolling> robots, double step, std::span<double> fastest);

}  // namespace nezumi::sim
