// The work of a robot in a tick: read sensors, check the velocity, drive.
#include "engine/robot/robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/list.hpp"
#include "engine/ports/payload.hpp"
#include "engine/robot/robot_parameters.hpp"
#include "engine/world/frames.hpp"

namespace nezumi {

Robot::Robot(std::string name, const RobotSpec& spec, const Limits& limits)
    : Device(std::move(name), spec.model),
      spec_(spec),
      guard_(limits),
      odometry_(spec.drive.radius_of_left(), spec.drive.radius_of_right(), spec.drive.track,
                spec.drive.encoder_pulses()),
      actuators_(spec) {
    for (std::size_t i = 0; i < spec.sensors.size(); ++i) {
        const auto& needs = spec.drive.needs;
        if (contains(needs, spec.sensors[i].name)) needed_.push_back({.sensor = i});
        if (spec.sensors[i].kind == SensorSpec::Kind::scan || spec.sensors[i].kind == SensorSpec::Kind::neighbours)
            scans_.push_back({.sensor = i});
    }
}

Robot::~Robot() {
    if (body_ != nullptr) body_->set_wheel_speeds({});
}

// The motors of a real robot get power only when it becomes ACTIVE, even if they had power before.
void Robot::take_body(std::unique_ptr<RobotBody> body) {
    body_ = std::move(body);
    powered_ = has_body() && !is_real();
}

void Robot::take_scripted_body(std::unique_ptr<RobotBody> simulated) {
    auto body = std::make_unique<ScriptedBody>(spec_, ScriptedBody::Ports{in_ports_, out_ports_}, std::move(simulated));
    scripted_ = body.get();
    take_body(std::move(body));
}

void Robot::forget(const Component& gone) {
    if (twin_ != nullptr) twin_->forget(gone);
    if (scripted_ != nullptr) scripted_->forget(gone);
}

Expected<void> Robot::follow(const Robot& real, const World& world) {
    if (find_port("error") != nullptr)
        return failure("a twin has an out-port 'error', and its model has a port of this name already");
    auto& error =
        add_out_port<Pose2D>("error", "the real robot's odometry, as its twin sees it: x ahead, y to the left");
    twin_ = std::make_unique<Twin>(real, world, id(), error);
    return {};
}

Expected<std::unique_ptr<Robot>> Robot::make(std::string name, const RobotSpec& spec, const Limits& limits) {
    std::unique_ptr<Robot> robot(new Robot(std::move(name), spec, limits));
    for (const PortSpec& port : spec.ports) {
        if (auto ok = robot->add_port(port); !ok) {
            return failure(fmt::format("port '{}': {}", port.name, ok.error().message), spec.place);
        }
    }
    if (auto ok = robot->add_servo_speeds(); !ok) return failure(ok.error().message, spec.place);
    return robot;
}

Expected<void> Robot::add_servo_speeds() {
    for (std::size_t i = 0; i < spec_.actuators.size(); ++i) {
        auto speed = speed_parameter(spec_.actuators[i]);
        if (!speed) continue;
        if (auto ok = parameters_.declare(std::move(*speed)); !ok) return ok;
        servos_.push_back(i);
    }
    return {};
}

Expected<void> Robot::on_activated() {
    guard_.stop();
    coasting_ = spec_.drive.coasts_until_commanded;
    for (Needed& needed : needed_) needed = {.sensor = needed.sensor};
    if (twin_ != nullptr) twin_->begin_anew();
    if (is_real() && (say_in_ != nullptr || !neighbour_ports_.empty()) && !std::exchange(said_deaf_, true))
        log(LogLevel::warn,
            "neighbours and what they say exist only in simulation: this real robot sees none and says nothing");
    return {};
}

// Whether each sensor that the robot needs for driving gave a value less than `longest_blindness` ago.
bool Robot::hears_what_it_needs(const Time& now) {
    bool hears = true;
    std::vector<std::string_view> lost, back;
    for (Needed& needed : needed_) {
        if (needed.sensor < readings_.size() && readings_[needed.sensor].is_there) {
            needed.heard_at = readings_[needed.sensor].tm;
            needed.was_heard = true;
        }
        if (!needed.heard_at) needed.heard_at = now.seconds;
        const bool is_silent = now.seconds - *needed.heard_at >= longest_blindness;
        hears = hears && needed.was_heard && !is_silent;
        if (is_silent != std::exchange(needed.is_told, is_silent))
            (is_silent ? lost : back).push_back(spec_.sensors[needed.sensor].name);
    }
    if (!lost.empty())
        log(LogLevel::warn, fmt::format("stands: it needs readings of {} to drive, and gets none from {}",
                                        fmt::join(lost, ", "), lost.size() == 1 ? "it" : "them"));
    if (!back.empty()) log(LogLevel::info, fmt::format("gets readings again from {}", fmt::join(back, ", ")));
    return hears;
}

bool Robot::is_due_at(double port_rate, const Time& now) const {
    return port_rate <= 0 || port_rate >= tick_rate() || nezumi::is_due(now.tick, port_rate, tick_rate(), now.left_out);
}

// Simulated robots use only simulated time: their world takes the same steps in every tick, however long the tick
// lasts.
double Robot::period_until(const Time& now, std::optional<double> last) const {
    return is_real() && last ? now.seconds - *last : 1.0 / tick_rate();
}

void Robot::take_parameters() {
    parameters_.take_staged();
    if (std::exchange(parameters_version_, parameters_.version()) == parameters_.version()) return;
    for (std::size_t i = 0; i < servos_.size(); ++i)
        actuators_.set_servo_speed(servos_[i], parameters_.all()[i].value.get<double>());
}

void Robot::tell_faults() {
    for (std::string& fault : body_->take_faults()) log(LogLevel::warn, std::move(fault));
}

// The pose in the body frame after a servo has turned it.
Pose3D Robot::turned(const Pose3D& pose, std::size_t servo) const {
    const Point3D &at = pose.position, &axis = spec_.actuators[servo].at;
    const double angle = body_->servo_angle(servo);
    const Point2D now = placed_at({{axis.x, axis.y}, angle}, {{at.x - axis.x, at.y - axis.y}, 0}).position;
    return {.position = {now.x, now.y, at.z}, .orientation = {.r = 0, .p = 0, .y = pose.orientation.y + angle}};
}

// Wheels without a measurement count as standing.
Velocity2D Robot::velocity_of(const WheelReading& wheels) const {
    if (!wheels.is_there) return {};
    const double left = wheels.speeds.left, right = wheels.speeds.right;
    return {.vx = (left + right) / 2, .vy = 0, .va = (right - left) / spec_.drive.track};
}

void Robot::publish_wheels(const WheelReading& wheels, const Time& now) {
    for (const auto& port : velocity_ports_) {
        if (!is_due_at(port.rate, now)) continue;
        port.port->write(measured_);
        if (wheels.tm != now.seconds) port.port->stamp(wheels.tm);
    }
    for (const auto& port : pose_ports_) {
        if (!is_due_at(port.rate, now)) continue;
        port.port->write(odometry_.pose());
        if (wheels.tm != now.seconds) port.port->stamp(wheels.tm);
    }
}

void Robot::publish(const SensorPort& port, std::span<const SensorReading> readings, const Time& now) const {
    double oldest = now.seconds;
    for (const std::size_t sensor : port.sensors) {
        if (!readings[sensor].is_there) return;
        oldest = std::min(oldest, readings[sensor].tm);
    }
    const double hertz = port.rate > 0 ? std::min(port.rate, tick_rate()) : tick_rate();
    const std::span<const double> values =
        port.count > 0 ? body_->sensor_values(port.sensors.front()) : std::span<const double>();
    if (port.servo) {
        const Pose3D pose = turned(port.pose, *port.servo);
        port.write(port, readings, values, hertz, &pose);
    } else {
        port.write(port, readings, values, hertz, nullptr);
    }
    if (oldest != now.seconds) port.port->stamp(oldest);
}

void Robot::set_scans_due(const Time& now) {
    for (Scan& scan : scans_) {
        const bool due = std::any_of(sensor_ports_.begin(), sensor_ports_.end(),
                                     [&](const SensorPort& port) {
                                         return port.sensors.front() == scan.sensor && is_due_at(port.rate, now);
                                     }) ||
                         std::any_of(neighbour_ports_.begin(), neighbour_ports_.end(), [&](const NeighbourPort& port) {
                             return port.sensor == scan.sensor && is_due_at(port.rate, now);
                         });
        if (std::exchange(scan.is_due, due) != due) body_->set_due(scan.sensor, due);
    }
}

// Publishes only changes.
void Robot::publish_stalled() {
    if (stalled_out_ == nullptr || std::exchange(stalled_, body_->is_stalled()) == stalled_) return;
    stalled_out_->write(stalled_);
}

void Robot::sense(const Time& now) {
    const double period = period_until(now, std::exchange(sensed_at_, now.seconds));
    const WheelReading wheels = body_->read_wheels(now, period);
    if (wheels.is_there) odometry_.update(wheels.pulses);
    measured_ = velocity_of(wheels);
    measured_at_ = wheels.is_there ? std::optional(wheels.tm) : std::nullopt;
    tell_faults();
    if (state() != LifeState::active) return;
    take_parameters();
    set_scans_due(now);
    readings_ = body_->read_sensors(now, period);
    publish_stalled();
    if (wheels.is_there) publish_wheels(wheels, now);
    for (const SensorPort& port : sensor_ports_) {
        if (is_due_at(port.rate, now)) publish(port, readings_, now);
    }
    if (!neighbour_ports_.empty()) publish_neighbours(now);
    if (twin_ != nullptr) twin_->compare();
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
                log(LogLevel::warn, fmt::format("input '{}': a command of {} m/s and {} rad/s was {} (reported once)",
                                                velocity_in_->name(), velocity.vx, velocity.va, note));
            }
            break;
        case VelocityGuard::Verdict::not_finite:
            if (!std::exchange(said_not_finite_, true)) {
                log(LogLevel::warn,
                    fmt::format("input '{}': a command that is not finite stops the robot (reported once)",
                                velocity_in_->name()));
            }
            return;
    }
    if (velocity.vy != 0 && !std::exchange(said_sideways_, true)) {
        log(LogLevel::warn,
            fmt::format("input '{}': vy = {} m/s is ignored: two wheels can't drive sideways (reported once)",
                        velocity_in_->name(), velocity.vy));
    }
}

void Robot::take_velocities(const Time& now) {
    // The disconnected sender may have been the driving one: its last command no longer counts.
    const bool disconnected =
        std::exchange(seen_disconnections_, velocity_in_->disconnections()) != velocity_in_->disconnections();
    if (disconnected) guard_.stop();
    while (velocity_in_->is_new()) {
        const Velocity2D& velocity = velocity_in_->read();
        if (!stopped_) command(velocity, now);
    }
    if (disconnected && !velocity_in_->connected()) guard_.stop();
}

void Robot::emergency_stop() {
    if (std::exchange(stopped_, true)) return;
    guard_.stop();
    actuators_.stop(body_.get());
    if (velocity_in_ == nullptr) return;
    note_before_stop_ = velocity_in_->note();
    velocity_in_->set_note("emergency stop: commands are ignored until rearm()");
}

void Robot::rearm() {
    stopped_ = false;
    braked_at_.reset();
    actuators_.rearm();
    set_motor_power(!is_real() || state() == LifeState::active);
    if (velocity_in_ == nullptr) return;
    velocity_in_->clear();  // drops commands that were sent before, but not yet read
    velocity_in_->set_note(note_before_stop_);
}

void Robot::set_motor_power(bool on) {
    if (std::exchange(powered_, on) != on) body_->set_motor_power(on);
}

// A real robot's motors have power from its activation until it stands after a deactivation or an error, because a
// person may pick it up.
void Robot::power_while_active(const Velocity2D& velocity, const Time& now) {
    if (!is_real() || stopped_) return;
    if (state() == LifeState::active) {
        braked_at_.reset();
        set_motor_power(true);
    } else if (velocity == Velocity2D{} && has_come_to_rest(now)) {
        set_motor_power(false);
    }
}

bool Robot::stands() const {
    constexpr double still_speed = 0.001;    // [m/s]
    constexpr double still_yaw_rate = 0.01;  // [rad/s]
    return guard_.current() == Velocity2D{} && std::abs(measured_.vx) < still_speed &&
           std::abs(measured_.va) < still_yaw_rate;
}

// Motors hold until the robot has stopped rocking and its wheels stand, but not longer than a limit: something else may
// be turning the wheels.
bool Robot::has_come_to_rest(const Time& now) {
    constexpr double rocking = 0.3, longest = 0.6;  // [s]
    if (!braked_at_) braked_at_ = now.seconds;
    const double since = now.seconds - *braked_at_;
    return !powered_ || (since >= rocking && stands()) || since >= longest;
}

void Robot::forget_velocities() {
    while (velocity_in_->is_new()) velocity_in_->read();
}

void Robot::take_pose() {
    while (pose_in_->is_new()) {
        const Pose2D& pose = pose_in_->read();
        if (is_finite(pose)) {
            odometry_.set_pose(pose);
        } else if (!std::exchange(said_lost_, true)) {
            log(LogLevel::warn,
                fmt::format("input '{}': a pose that is not finite is ignored (reported once)", pose_in_->name()));
        }
    }
}

void Robot::coast() {
    told_.reset();
    body_->coast();
}

void Robot::drive(const Time& now) {
    if (twin_ != nullptr) return twin_->drive(*body_, state() == LifeState::active);
    const double period = period_until(now, std::exchange(drove_at_, now.seconds));
    const bool stalled = is_real() && period >= std::max(shortest_stall, 3 / tick_rate());
    const bool may = state() != LifeState::active || (hears_what_it_needs(now) && body_->may_drive());
    if (stalled || at_rest_ || !may) {
        // Commands that arrived meanwhile are dropped: they were meant for an earlier position.
        guard_.stop();
        if (velocity_in_ != nullptr) forget_velocities();
    } else if (state() == LifeState::active) {
        if (velocity_in_ != nullptr) take_velocities(now);
    } else {
        guard_.stop();
        coasting_ = false;
    }
    if (stalled) {
        log(LogLevel::warn, fmt::format("stops: no tick was computed for {:.2f} s", period));
    }
    if (coasting_) {
        if (stopped_) set_motor_power(false);
        coast();
        return;
    }
    const Velocity2D velocity = guard_.advance(now.seconds, 1.0 / tick_rate(), period);
    if (stopped_ && velocity == Velocity2D{} && has_come_to_rest(now)) {
        set_motor_power(false);
        coast();
        return;
    }
    power_while_active(velocity, now);
    const double turn = velocity.va * spec_.drive.track / 2;
    const Wheels speeds{.left = velocity.vx - turn, .right = velocity.vx + turn};
    told_ = powered_ ? std::optional(speeds) : std::nullopt;
    body_->set_wheel_speeds(speeds);
}

void Robot::actuate(const Time& now) {
    drive(now);
    if (state() == LifeState::active) {
        if (pose_in_ != nullptr) take_pose();
        if (say_in_ != nullptr) take_message(now);
        actuators_.act(*body_, now, [this](std::string why) { log(LogLevel::warn, std::move(why)); });
    } else {
        say({});
        actuators_.be_still(*body_);
    }
}

}  // namespace nezumi
