// The step of a robot that touches nothing but the flat floor, in closed form: it is what ODE's solver would find.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "engine/world/world.hpp"
#include "sim/bodies.hpp"

namespace nezumi::sim {

/// Where a robot's wheels and skids reach lowest.
struct Supports {
    static constexpr std::size_t wheels = 2, count = 4;
    std::array<Vec3, count>
        at;             ///< [m] left and right wheel, front and rear skid; what is below the floor presses on it
    Vec3 forward;       ///< horizontal, along which both wheels roll
    bool wheels_stand;  ///< whether the wheels are upright enough to touch the floor with their rims
};
Supports supports_of(const RobotModel& model, const Vec3& centre, const Rotation& rotation);

/// The robot's velocities after a step of `step` [s] with these speeds of its wheels [m/s]: the solution of the
/// equations that `dWorldStep` sets up for its springs, motors and friction, as long as none of their bounds is active.
/// Nothing when one may be: a support that would be pulled, a wheel that may slip, a hull that may touch the floor.
std::optional<Motion> roll_freely(const RobotModel& model, const BodyState& body, const Wheels& speeds, double step);

/// A robot that takes several steps.
struct Rolling {
    BodyState body;
    Wheels speeds;      ///< [m/s]
    bool rolls = true;  ///< freely, in each of the steps; otherwise `body` is of no use afterwards
};
/// Advances robots of one model, at most `Lanes::count`, by `fastest.size()` steps each, as above, to the last bit.
/// Raises the elements of `fastest` to the squared speed [m/s] of the fastest after each step, of those that have
/// rolled until then.
void roll_freely(const RobotModel& model, std::span<Rolling> robots, double step, std::span<double> fastest);

}  // namespace nezumi::sim
