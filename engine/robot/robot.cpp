// What a robot does in a tick: sense, guard the velocity, act.
#include "engine/robot/robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/ports/payload.hpp"

namespace nezumi {

Robot::Robot(std::string name, const RobotSpec& spec, const Limits& limits, RobotId id, std::uint64_t seed)
    : Device(std::move(name), spec.model),
      spec_(spec),
      id_(id),
      guard_(limits),
      odometry_(spec.drive.radius, spec.drive.radius, spec.drive.track, spec.drive.pulses_per_turn),
      sensors_(spec, mix(seed, std::string_view(this->name()))),
      actuators_(spec) {}

Robot::~Robot() {
    if (body_ != nullptr) body_->set_wheel_speeds({});
}

Expected<std::unique_ptr<Robot>> Robot::make(std::string name, const RobotSpec& spec, const Limits& limits, RobotId id,
                                             std::uint64_t seed) {
    std::unique_ptr<Robot> robot(new Robot(std::move(name), spec, limits, id, seed));
    for (const PortSpec& port : spec.ports) {
        if (auto ok = robot->add_port(port); !ok) {
            return failure(fmt::format("port '{}': {}", port.name, ok.error().message), spec.place);
        }
    }
    return robot;
}

Expected<void> Robot::on_activated() {
    guard_.stop();
    coasting_ = spec_.drive.coasts_until_commanded;
    return {};
}

bool Robot::is_due_at(double port_rate, const Time& now) const {
    return port_rate <= 0 || port_rate >= tick_rate() || nezumi::is_due(now.tick, port_rate, tick_rate());
}

// Where a sensor is in the body frame now that its servo has turned it.
Pose3D Robot::pose_on_servo(std::size_t sensor, std::size_t servo) const {
    const Point3D &at = spec_.sensors[sensor].at, &axis = spec_.actuators[servo].at;
    const double angle = actuators_.servo_angle(servo), c = std::cos(angle), s = std::sin(angle);
    const double x = at.x - axis.x, y = at.y - axis.y;
    return {.position = {axis.x + c * x - s * y, axis.y + s * x + c * y, at.z},
            .orientation = {.r = 0, .p = 0, .y = spec_.sensors[sensor].yaw + angle}};
}

void Robot::sense(const Time& now) {
    const Wheels angles = body_->wheel_angles();
    odometry_.update(angles);
    const double left = (angles.left - angles_.left) * spec_.drive.radius * tick_rate();
    const double right = (angles.right - angles_.right) * spec_.drive.radius * tick_rate();
    const Velocity2D measured =
        sensed_ ? Velocity2D{.vx = (left + right) / 2, .vy = 0, .va = (right - left) / spec_.drive.track}
                : Velocity2D{};
    angles_ = angles;
    sensed_ = true;
    if (state() != LifeState::active) return;

    sensors_.read(*body_, now, 1.0 / tick_rate());
    for (const auto& port : velocity_ports_) {
        if (is_due_at(port.rate, now)) port.port->write(measured);
    }
    for (const auto& port : pose_ports_) {
        if (is_due_at(port.rate, now)) port.port->write(odometry_.pose());
    }
    for (const SensorPort& port : sensor_ports_) {
        if (!is_due_at(port.rate, now)) continue;
        outgoing_.clear();
        for (const std::size_t sensor : port.sensors)
            outgoing_.push_back(port.distance ? sensors_.distance(sensor) : sensors_.value(sensor));
        const double hertz = port.rate > 0 ? std::min(port.rate, tick_rate()) : tick_rate();
        if (port.servo) {
            const Pose3D turned = pose_on_servo(port.sensors.front(), *port.servo);
            port.write(*port.port, outgoing_, hertz, &turned);
        } else {
            port.write(*port.port, outgoing_, hertz, nullptr);
        }
    }
}

void Robot::command(const Velocity2D& velocity, const Time& now) {
    coasting_ = false;
    switch (guard_.command(velocity, now.seconds)) {
        case VelocityGuard::Verdict::taken: break;
        case VelocityGuard::Verdict::clamped:
            if (!std::exchange(said_clamped_, true)) {
                const std::string note =
                    fmt::format("limited to {} m/s and {} rad/s", guard_.limits().speed, guard_.limits().yaw_rate);
                velocity_in_->set_note(note);
                log(LogLevel::warn, fmt::format("input '{}': a command of {} m/s and {} rad/s was {} (said once)",
                                                velocity_in_->name(), velocity.vx, velocity.va, note));
            }
            break;
        case VelocityGuard::Verdict::not_finite:
            if (!std::exchange(said_not_finite_, true)) {
                log(LogLevel::warn, fmt::format("input '{}': a command that is not finite stops the robot (said once)",
                                                velocity_in_->name()));
            }
            return;
    }
    if (velocity.vy != 0 && !std::exchange(said_sideways_, true)) {
        log(LogLevel::warn,
            fmt::format("input '{}': vy = {} m/s is ignored: two wheels can't drive sideways (said once)",
                        velocity_in_->name(), velocity.vy));
    }
}

void Robot::take_velocities(const Time& now) {
    // Whoever was disconnected may have been the one that drives: what it said last no longer counts.
    const bool disconnected =
        std::exchange(seen_disconnections_, velocity_in_->disconnections()) != velocity_in_->disconnections();
    if (disconnected) guard_.stop();
    while (velocity_in_->is_new()) command(velocity_in_->read(), now);
    if (disconnected && !velocity_in_->connected()) guard_.stop();
}

void Robot::take_pose() {
    while (pose_in_->is_new()) {
        const Pose2D& pose = pose_in_->read();
        if (is_finite(pose)) {
            odometry_.set_pose(pose);
        } else if (!std::exchange(said_lost_, true)) {
            log(LogLevel::warn,
                fmt::format("input '{}': a pose that is not finite is ignored (said once)", pose_in_->name()));
        }
    }
}

void Robot::drive(const Time& now) {
    if (state() == LifeState::active) {
        if (velocity_in_ != nullptr) take_velocities(now);
    } else {
        guard_.stop();
        coasting_ = false;
    }
    if (coasting_) {
        body_->coast();
        return;
    }
    const Velocity2D velocity = guard_.advance(now.seconds, 1.0 / tick_rate());
    const double turn = velocity.va * spec_.drive.track / 2;
    body_->set_wheel_speeds({.left = velocity.vx - turn, .right = velocity.vx + turn});
}

void Robot::actuate(const Time& now) {
    drive(now);
    if (state() == LifeState::active) {
        if (pose_in_ != nullptr) take_pose();
        actuators_.act(*body_, now, tick_rate(), [this](std::string why) { log(LogLevel::warn, std::move(why)); });
    } else {
        actuators_.be_still(*body_);
    }
}

}  // namespace nezumi
