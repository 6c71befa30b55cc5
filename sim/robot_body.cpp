// A robot's sensors and motors in the world, by its number.
#include "sim/robot_body.hpp"

#include <cassert>
#include <cmath>

#include "sim/floor_spot.hpp"
#include "sim/ode_world.hpp"

namespace nezumi::sim {

SimRobotBody::~SimRobotBody() { world_.remove_robot(id_); }

Wheels SimRobotBody::wheel_angles() const { return world_.robot(id_).angles; }

void SimRobotBody::read_ranges(std::span<double> distances, std::span<const std::uint8_t> due) const {
    world_.read_ranges(world_.robot(id_), distances, due);
}

double SimRobotBody::yaw_rate() const { return world_.robot(id_).body.w[2]; }

PlaceMotion SimRobotBody::motion(std::size_t index) const {
    const SimRobot& robot = world_.robot(id_);
    const SensorSpec& sensor = robot.model->spec->sensors[index];
    const Rotation hull = robot.body.rotation(), frame = hull * yaw_rotation(sensor.yaw);
    const Vec3 at = rotate(hull, to_vec(sensor.at) + robot.model->origin);
    return {.axes = {{to_point(frame.col(0)), to_point(frame.col(1)), to_point(frame.col(2))}},
            .velocity = to_point(robot.body.velocity_at(at)),
            .spin = to_point(robot.body.spin())};
}

bool SimRobotBody::is_pressed(std::size_t index) const {
    const SimRobot& robot = world_.robot(id_);
    if (robot.pressed[index]) return true;
    const SensorSpec& sensor = robot.model->spec->sensors[index];
    return sensor.kind == SensorSpec::Kind::touch && world_.touches_something(robot, sensor);
}

FloorColor SimRobotBody::floor_color(std::size_t index) const {
    const SimRobot& robot = world_.robot(id_);
    const auto seen = world_.floor_under(robot, robot.model->spec->sensors[index]);
    return seen ? nearest_floor_color(*seen) : FloorColor::none;
}

double SimRobotBody::reflected_light(std::size_t index) const {
    const SimRobot& robot = world_.robot(id_);
    const auto seen = world_.floor_under(robot, robot.model->spec->sensors[index]);
    return seen ? brightness(*seen) : 0;
}

void SimRobotBody::list_neighbours(std::size_t index, std::vector<InSight>& seen) const {
    const SimRobot& robot = world_.robot(id_);
    world_.list_neighbours(robot, robot.model->spec->sensors[index], seen);
}

void SimRobotBody::say(std::span<const double> message) {
    world_.change_signals(id_).message.assign(message.begin(), message.end());
}

void SimRobotBody::set_leds(const std::vector<bool>& on) { world_.change_signals(id_).leds = on; }

void SimRobotBody::set_wheel_speeds(Wheels speeds) {
    assert(std::isfinite(speeds.left) && std::isfinite(speeds.right));
    SimRobot& robot = world_.robot(id_);
    robot.speeds = speeds;
    robot.coasting = false;
}

void SimRobotBody::coast() { world_.robot(id_).coasting = true; }

void SimRobotBody::play(const Sound& sound) { world_.play(world_.robot(id_), sound); }

void SimRobotBody::set_servo(std::size_t index, double angle) {
    assert(std::isfinite(angle));
    SimRobot& robot = world_.robot(id_);
    if (robot.servos[index] == angle) return;
    robot.servos[index] = angle;
    if (!robot.model->has_servo_sensors) return;
    robot.turned_fan = std::make_unique<RayFan>(robot.model->fan_at(robot.servos));
}

}  // namespace nezumi::sim
