// Touch and colour sensors of simulated robots, and what they see of each other.
#include <cassert>
#include <cmath>
#include <utility>

#include "sim/floor_spot.hpp"
#include "sim/ode_world.hpp"

namespace nezumi::sim {

void OdeWorld::read_ranges(const SimRobot& robot, std::span<double> distances,
                           std::span<const std::uint8_t> due) const {
    const RayFan& fan = robot.fan();
    if (fan.sensors == 0) return;
    cast_rays(scene_, fan, robot.body.centre(), robot.body.rotation(), robot.mover, distances, due);
}

void OdeWorld::list_neighbours(const SimRobot& robot, const SensorSpec& sensor,
                               std::vector<SimulatedBody::InSight>& seen) const {
    const Rotation hull = robot.body.rotation();
    const Vec3 at = robot.body.centre() + rotate(hull, to_vec(sensor.at) + robot.model->origin);
    const Vec3 ahead = rotate(hull, {std::cos(sensor.yaw), std::sin(sensor.yaw), 0});
    scene_.for_each_mover_near(at.x(), at.y(), sensor.radius, robot.mover, [&](Scene::Index index, const Shape& shape) {
        if (movers_.is_thing(index)) return;
        const SimRobot& other = movers_.robot(index);
        const double dx = shape.centre.x() - at.x(), dy = shape.centre.y() - at.y();
        const double range = std::hypot(dx, dy);
        if (other.gone || range > sensor.radius ||
            !is_clear(scene_, at, {at.x() + dx, at.y() + dy, at.z()}, robot.mover, index))
            return;
        const double bearing = std::atan2(ahead.x() * dy - ahead.y() * dx, ahead.x() * dx + ahead.y() * dy);
        const auto id = static_cast<RobotId>(&other - movers_.robots.data());
        seen.push_back({id, range, bearing, other.name, &signals_[id].now});
    });
}

Signals& OdeWorld::change_signals(RobotId id) {
    ShownSignals& shown = signals_[id];
    shown.have_changed = true;
    signals_have_changed_.store(true, std::memory_order_relaxed);
    return shown.next;
}

void OdeWorld::publish_signals() {
    if (!signals_have_changed_.exchange(false, std::memory_order_relaxed)) return;
    for (ShownSignals& shown : signals_) {
        if (std::exchange(shown.have_changed, false)) shown.now = shown.next;
    }
}

// A touch sensor is a plunger that extends by its travel. It closes when an obstacle has pushed it in: three rays
// across its tip test this, starting behind the hull's surface.
bool OdeWorld::touches_something(const SimRobot& robot, const SensorSpec& sensor) const {
    constexpr double half_tip = 0.006;  // [m] half the width of the tip
    constexpr double behind = 0.005;    // [m] because contacts are soft
    constexpr double nearly = 0.0015;   // [m] part of the travel that may remain: a robot that pushes leans back
    const Rotation rotation = robot.body.rotation();
    const Vec3 at = to_vec(sensor.at) + robot.model->origin;
    const Vec3 out{std::cos(sensor.yaw), std::sin(sensor.yaw), 0}, aside{-out.y(), out.x(), 0};
    for (const double side : {0.0, half_tip, -half_tip}) {
        const Vec3 from = at - out * (sensor.travel + behind) + aside * side;
        const double distance = cast_ray(scene_, robot.body.centre() + rotate(rotation, from), rotate(rotation, out),
                                         behind + nearly, robot.mover);
        if (distance < nothing) return true;
    }
    return false;
}

std::optional<Rgb> OdeWorld::floor_under(const SimRobot& robot, const SensorSpec& sensor) const {
    constexpr double highest = 0.018;  // [m] the lamp lights the floor up to this height
    if (!floor_) return std::nullopt;
    const Vec3 from = to_vec(sensor.at) + robot.model->origin;
    const Vec3 at = robot.body.centre() + rotate(robot.body.rotation(), from);
    if (at.z() > highest) return std::nullopt;
    return floor_spot_color(*floor_, floor_size_, {at.x(), at.y()});
}

std::vector<Ray> OdeWorld::rays(RobotId id) const {
    const SimRobot& robot = movers_.robots[id];
    const Vec3 centre = robot.body.centre();
    const Rotation rotation = robot.body.rotation();
    std::vector<Ray> rays;
    for (const RayFan::RayFrom& ray : robot.fan().rays) {
        const Vec3 from = centre + rotate(rotation, ray.from), direction = rotate(rotation, ray.direction);
        const double distance = cast_ray(scene_, from, direction, ray.range, robot.mover);
        const bool hit = distance < nothing;
        const Vec3 to = from + direction * (hit ? distance : ray.range);
        rays.push_back({to_point(from), to_point(to), hit, ray.sensor});
    }
    return rays;
}

void OdeWorld::press(RobotId id, std::size_t sensor, bool pressed) {
    assert(sensor < robot(id).pressed.size());
    robot(id).pressed[sensor] = pressed;
}

}  // namespace nezumi::sim
