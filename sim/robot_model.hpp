// The physical model of a robot, derived once from its description.
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

/// A spring with a damper, as ODE's ERP and CFM (for one step length).
struct Spring {
    double erp = 0;
    double cfm = 0;

    /// `stiffness` [N/m], `damping` [N s/m], `step` [s]; ODE's manual, "How to use ERP and CFM".
    static Spring from(double stiffness, double damping, double step) {
        return {step * stiffness / (step * stiffness + damping), 1 / (step * stiffness + damping)};
    }
};

/// A constraint equation softened by `cfm`. The quotients are computed once, not in every step.
struct SoftEquation {
    double weight = 0;  ///< [kg] step / cfm
    double force = 0;   ///< [N s/m] 1 / cfm: force per m/s of velocity error

    static SoftEquation from(double cfm, double step) { return {step / cfm, 1 / cfm}; }
};

/// Stiffness and damping per kilogram of a body, so that light and heavy robots behave alike. Measured with a robot of
/// 1.6 kg at steps of 10 ms (erp 0.3 and cfm 1e-3; skids 0.183 and 0.0122; slip 5e-4).
namespace per_kilogram {
inline constexpr double firm = 18'750, firm_damping = 437.5;  ///< wheels, hulls, things
inline constexpr double skid = 940, skid_damping = 41.9;      ///< soft: rigid skids would lift the wheels on a ramp
inline constexpr double slip = 8e-4;                          ///< [m/s for each N, times kg] creep of a loaded wheel
inline constexpr double held_creep = 8e-8;                    ///< creep of a loaded wheel on a slope
}  // namespace per_kilogram

/// Common to the surfaces of all contacts.
inline constexpr int sprung = dContactSoftERP | dContactSoftCFM | dContactApprox1;

inline constexpr double gravity = 9.81;  // [m/s^2]
// [m/s] Overlapping bodies are pushed apart at this gentle speed.
inline constexpr double correcting_speed = 1.0;
inline constexpr double rolling_friction = 0.01;
inline constexpr double hull_friction = 0.3;
inline constexpr double thing_friction = 0.35;  // chosen so that a mouse can push 0.5 kg

/// The mass properties of a solid with this shape and mass [kg].
dMass mass_of(const Shape& shape, double mass);

/// A robot is one body: the hull, whose centre is the centre of mass. Wheels and skids are contact points. All
/// positions are relative to the hull's centre [m], in the robot's frame.
struct RobotModel {
    RobotModel(const RobotSpec& spec, double step);

    const RobotSpec* spec;
    Shape hull;                  ///< at the origin; its bottom is cut off if it would drag over the floor
    double hull_drop;            ///< height of the cut hull's centre above the original hull's
    Vec3 origin;                 ///< the body frame's origin
    double mass;                 ///< [kg]
    Vec3 inertia;                ///< [kg m^2] about the hull's axes
    double wheel_radius;         ///< nominal radius plus the compression of the wheel's spring
    std::array<Vec3, 2> wheels;  ///< centres: left, right
    double wheel_overhang;       ///< how far the wheels extend beyond the hull; negative: they don't
    std::array<Vec3, 2> skids;   ///< lowest points without load: front, rear
    double clearance;            ///< from a skid's lowest point to the hull's bottom
    double reach;                ///< radius of the upright cylinder that contains hull, wheels and skids
    Spring firm;
    // Contact templates: everything that does not change from step to step is set.
    dContact wheel_contact{};     ///< of a driven wheel; position, direction and speed are set per step
    dContact held_contact{};      ///< of a wheel held on a slope; position and direction are set per step
    dContact coasting_contact{};  ///< of a coasting wheel; position and direction are set per step
    dContact skid_contact{};      ///< position is set per step
    // The contacts of a robot that rolls freely.
    SoftEquation wheel_normal, wheel_along, wheel_across, skid_normal;

    RayFan fan;  ///< of range sensors and scans, with servos at 0; distances in the spec's order
    std::vector<std::size_t> range_sensors;  ///< indices of range sensors and scans in the spec
    bool has_servo_sensors = false;

    /// The rays at these servo angles [rad], one per actuator of the spec.
    RayFan fan_at(const std::vector<double>& servo_angles) const;
};

}  // namespace nezumi::sim
