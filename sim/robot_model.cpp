// Derives a robot's physics: its pose at rest, its springs and its rays.
#include "sim/robot_model.hpp"

#include <algorithm>
#include <cmath>

namespace nezumi::sim {
namespace {

// The lowest clearance of a hull [m]: a hull on the floor would brake the robot.
constexpr double least_clearance = 0.004;

// The smallest horizontal distance of a skid from the axle [m]: with both skids under the axle a robot would tip over.
constexpr double least_skid = 0.005;

}  // namespace

dMass mass_of(const Shape& shape, double mass) {
    dMass m;
    if (shape.kind == Shape::Kind::box) {
        dMassSetBoxTotal(&m, mass, 2 * shape.half.x(), 2 * shape.half.y(), 2 * shape.half.z());
    } else {
        dMassSetCylinderTotal(&m, mass, 3, shape.half.x(), 2 * shape.half.z());
    }
    return m;
}

RobotModel::RobotModel(const RobotSpec& robot, double step)
    : spec(&robot),
      origin(-to_vec(robot.body.at)),
      mass(robot.mass),
      firm(Spring::from(per_kilogram::firm * mass, per_kilogram::firm_damping * mass, step)) {
    const bool box = robot.body.shape == BodySpec::Shape::box;
    hull.kind = box ? Shape::Kind::box : Shape::Kind::cylinder;
    hull.half = to_vec(robot.body.size) * 0.5;
    const double top = robot.body.at.z + hull.half.z();
    const double bottom = std::max(robot.body.at.z - hull.half.z(), std::min(least_clearance, top - 0.001));
    hull.half.z() = (top - bottom) / 2;
    hull_drop = (top + bottom) / 2 - robot.body.at.z;
    const dMass solid = mass_of(hull, mass);
    inertia = {solid.I[0], solid.I[5], solid.I[10]};

    // At rest the wheels carry most of the load and each skid about 15 %, depending on where the hull's centre is
    // relative to the axle, so that the robot stands level. Wheels and skids are made longer by the compression of
    // their springs.
    const DriveSpec& drive = robot.drive;
    const double arm = std::max(drive.skid, least_skid);
    const double shift = std::clamp(robot.body.at.x / arm, -0.9, 0.9);  // front minus rear, as a part of the weight
    double front = 0.15 + shift / 2, rear = 0.15 - shift / 2;
    if (front < 0) {
        rear -= front;
        front = 0;
    } else if (rear < 0) {
        front -= rear;
        rear = 0;
    }
    const double on_wheel = (1 - front - rear) / 2;
    wheel_radius = drive.radius + on_wheel * gravity / per_kilogram::firm;
    const double axle = origin.z() + drive.radius;
    wheels = {Vec3{origin.x(), origin.y() + drive.track / 2, axle},
              Vec3{origin.x(), origin.y() - drive.track / 2, axle}};
    // The half width of a disc at the axle is less than its radius.
    const double x = origin.x(),
                 half_width = box ? hull.half.y() : std::sqrt(std::max(0.0, hull.half.x() * hull.half.x() - x * x));
    wheel_overhang = drive.track / 2 - (half_width + origin.y());
    // A tall robot would fall over soft skids. One skid alone must give three times the tilting torque of gravity.
    const double stiffness = std::max(per_kilogram::skid, 3 * gravity * robot.body.at.z / (arm * arm));
    const double damping = per_kilogram::skid_damping * std::sqrt(stiffness / per_kilogram::skid);
    const double skid_give = gravity / stiffness;
    skids = {Vec3{origin.x() + arm, origin.y(), origin.z() - front * skid_give},
             Vec3{origin.x() - arm, origin.y(), origin.z() - rear * skid_give}};
    clearance = bottom;

    wheel_contact.surface.mode = sprung | dContactFDir1 | dContactSlip1 | dContactSlip2;
    wheel_contact.surface.mu = robot.friction;
    wheel_contact.surface.slip1 = wheel_contact.surface.slip2 = per_kilogram::slip / mass;
    wheel_contact.surface.soft_erp = firm.erp;
    wheel_contact.surface.soft_cfm = firm.cfm;
    coasting_contact = wheel_contact;
    // Creep makes a driven wheel smooth, but a standing robot would glide down any slope. The skids carry a part of the
    // weight without friction; the larger mu lets the robot stand up to the angle of friction all the same.
    held_contact = wheel_contact;
    held_contact.surface.mu = robot.friction / (1 - front - rear);
    held_contact.surface.slip1 = held_contact.surface.slip2 = per_kilogram::held_creep / mass;
    wheel_contact.surface.mode |= dContactMotion1;
    coasting_contact.surface.mode |= dContactMu2;  // free along, firm across
    coasting_contact.surface.mu = rolling_friction;
    coasting_contact.surface.mu2 = robot.friction;
    const Spring soft = Spring::from(stiffness * mass, damping * mass, step);
    skid_contact.surface.mode = sprung;
    skid_contact.surface.soft_erp = soft.erp;
    skid_contact.surface.soft_cfm = soft.cfm;
    wheel_normal = SoftEquation::from(firm.cfm, step);
    wheel_along = SoftEquation::from(wheel_contact.surface.slip1, step);
    wheel_across = SoftEquation::from(wheel_contact.surface.slip2, step);
    skid_normal = SoftEquation::from(soft.cfm, step);

    reach = hull.reach();
    for (const Vec3& wheel : wheels) reach = std::max(reach, wheel.norm() + wheel_radius);
    for (const Vec3& point : skids) reach = std::max(reach, point.norm());

    for (std::size_t i = 0; i < robot.sensors.size(); ++i) {
        if (robot.sensors[i].kind != SensorSpec::Kind::range && robot.sensors[i].kind != SensorSpec::Kind::scan)
            continue;
        range_sensors.push_back(i);
        if (!robot.sensors[i].on.empty()) has_servo_sensors = true;
    }
    fan = fan_at(std::vector<double>(robot.actuators.size(), 0.0));
}

RayFan RobotModel::fan_at(const std::vector<double>& servo_angles) const {
    RayFan rays;
    std::size_t slot = 0;  // index of the distance
    for (const std::size_t index : range_sensors) {
        const SensorSpec& sensor = spec->sensors[index];
        Vec3 at = to_vec(sensor.at);
        double yaw = sensor.yaw;
        for (std::size_t a = 0; a < spec->actuators.size(); ++a) {
            const ActuatorSpec& servo = spec->actuators[a];
            if (servo.name != sensor.on || servo.kind != ActuatorSpec::Kind::servo) continue;
            at = to_vec(servo.at) + rotate(yaw_rotation(servo_angles[a]), at - to_vec(servo.at));
            yaw += servo_angles[a];
        }
        if (sensor.kind == SensorSpec::Kind::scan) {
            const ScanAngles angles = angles_of(sensor);
            const auto count = static_cast<std::size_t>(sensor.rays);
            rays.add_scan({.from = at + origin, .range = sensor.range, .sensor = slot}, yaw + angles.first, angles.step,
                          count);
            slot += count;
            continue;
        }
        const int count = sensor.cone > 0 ? std::max(1, sensor.rays) : 1;
        for (int k = 0; k < count; ++k) {
            const double angle = count == 1 ? yaw : yaw + sensor.cone * (static_cast<double>(k) / (count - 1) - 0.5);
            rays.add({at + origin, {std::cos(angle), std::sin(angle), 0}, sensor.range, slot});
        }
        ++slot;
    }
    rays.sensors = slot;
    return rays;
}

}  // namespace nezumi::sim
