// What physics needs to know of a robot, derived once from its description.
#pragma once

#include <ode/common.h>
#include <ode/contact.h>
#include <ode/mass.h>

#include <array>
#include <vector>

#include "engine/world/robot_spec.hpp"
#include "sim/ray_caster.hpp"
#include "sim/shape.hpp"

namespace nezumi::sim {

/// A spring with a damper, as the two numbers ODE's solver takes (for one step length).
struct Spring {
    double erp = 0;
    double cfm = 0;

    /// `stiffness` [N/m], `damping` [N s/m], `step` [s]; ODE's manual, "How to use ERP and CFM".
    static Spring from(double stiffness, double damping, double step) {
        return {step * stiffness / (step * stiffness + damping), 1 / (step * stiffness + damping)};
    }
};

/// An equation that a `cfm` softens, as a step weighs it: divided once, not in every step.
struct SoftEquation {
    double weight = 0;  ///< [kg] step / cfm
    double force = 0;   ///< [N s/m] 1 / cfm, for each m/s that the velocity misses

    static SoftEquation from(double cfm, double step) { return {step / cfm, 1 / cfm}; }
};

/// Stiffness and damping for each kilogram of a body, so that a light robot and a heavy one sink in, nod and bounce
/// alike. Measured with a robot of 1.6 kg at steps of 10 ms (erp 0.3 and cfm 1e-3; skids 0.183 and 0.0122; slip 5e-4).
namespace per_kilogram {
inline constexpr double firm = 18'750, firm_damping = 437.5;  ///< wheels, hulls, things
inline constexpr double skid = 940, skid_damping = 41.9;      ///< soft: rigid skids high-centre on a ramp of 5 degrees
inline constexpr double slip = 8e-4;                          ///< [m/s for each N, times kg] creep of a loaded wheel
inline constexpr double held_creep = 8e-8;                    ///< the same of one that stands on a slope
}  // namespace per_kilogram

/// What the surfaces of all contacts have in common.
inline constexpr int sprung = dContactSoftERP | dContactSoftCFM | dContactApprox1;

inline constexpr double gravity = 9.81;  // [m/s^2]
// [m/s] What has got into something else is pushed out gently instead of being shot.
inline constexpr double correcting_speed = 1.0;
inline constexpr double rolling_friction = 0.01;
inline constexpr double hull_friction = 0.3;
inline constexpr double thing_friction = 0.35;  // a mouse can push half a kilogram

/// Of a solid of this shape and mass [kg].
dMass mass_of(const Shape& shape, double mass);

/// A robot is one body: the hull, whose centre is the centre of mass. Wheels and skids are points where it touches what
/// lies below. All places are from the hull's centre [m], in the robot's frame.
struct RobotModel {
    RobotModel(const RobotSpec& spec, double step);

    const RobotSpec* spec;
    Shape hull;           ///< at the origin; its bottom is cut off where it would drag over the floor
    double hull_drop;     ///< the cut hull's centre is so much above the hull's own
    Vec3 origin;          ///< the body frame's origin
    double mass;          ///< [kg]
    Vec3 inertia;         ///< [kg m^2] about the hull's axes
    double wheel_radius;  ///< what the floor feels: a little more than the nominal one, by which the wheel sinks in
    std::array<Vec3, 2> wheels;  ///< centres: left, right
    double wheel_overhang;       ///< by how much the wheels stand out beside the hull; negative: they don't
    std::array<Vec3, 2> skids;   ///< lowest points when nothing presses: front, rear
    double clearance;            ///< from a skid's lowest point to the hull's bottom
    double reach;                ///< the upright cylinder of this radius holds hull, wheels and skids
    Spring firm;
    // Contacts in which everything is set that does not change from step to step.
    dContact wheel_contact{};     ///< of a driven wheel: lacks its place, direction and speed
    dContact held_contact{};      ///< of a wheel that is held on a slope: lacks its place and direction
    dContact coasting_contact{};  ///< of a wheel that rolls freely: lacks its place and direction
    dContact skid_contact{};      ///< lacks its place
    // The same of a robot that rolls freely.
    SoftEquation wheel_normal, wheel_along, wheel_across, skid_normal;

    RayFan fan;                              ///< of range sensors and scans, servos at 0; distances in the spec's order
    std::vector<std::size_t> range_sensors;  ///< which sensors of the spec they are
    bool has_servo_sensors = false;

    /// The rays with the spec's actuators at these angles [rad].
    RayFan fan_at(const std::vector<double>& servo_angles) const;
};

}  // namespace nezumi::sim
