// What a robot does in a tick: sense, guard the velocity, act.
#include "engine/robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nezumi {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The nearest value that an integer of type T holds.
template <class T>
T saturate(double value) {
    if constexpr (std::is_same_v<T, bool>) {
        return value != 0;
    } else if constexpr (std::is_integral_v<T>) {
        const double lowest = std::numeric_limits<T>::lowest();
        const double highest = std::numeric_limits<T>::max();
        return static_cast<T>(std::round(value < lowest ? lowest : value > highest ? highest : value));
    } else {
        return static_cast<T>(value);
    }
}

// How sensors' values go into a message of type T; nullptr where they don't.
using WriteValues = void (*)(OutPortBase&, const std::vector<double>&);

template <class T>
constexpr WriteValues write_values() {
    if constexpr (std::is_arithmetic_v<T>) {
        return [](OutPortBase& port, const std::vector<double>& values) {
            static_cast<OutPort<T>&>(port).write(saturate<T>(values.front()));
        };
    } else if constexpr (Sequence<T>) {
        using Element = typename T::value_type;
        if constexpr (std::is_arithmetic_v<Element>) {
            return [](OutPortBase& port, const std::vector<double>& values) {
                T& slot = static_cast<OutPort<T>&>(port).next_pending();
                slot.resize(values.size());
                for (std::size_t i = 0; i < values.size(); ++i) slot[i] = saturate<Element>(values[i]);
            };
        } else {
            return nullptr;
        }
    } else if constexpr (std::is_same_v<T, RangeData>) {
        return [](OutPortBase& port, const std::vector<double>& values) {
            static_cast<OutPort<RangeData>&>(port).next_pending().ranges = values;
        };
    } else {
        return nullptr;
    }
}

template <class T>
constexpr bool single = std::is_arithmetic_v<T>;

// A number in (0, 1] from a hash.
double uniform(std::uint64_t hash) { return (static_cast<double>(hash >> 11) + 1.0) * 0x1p-53; }

}  // namespace

Robot::Robot(std::string name, const RobotSpec& spec, const Limits& limits, RobotId id, std::uint64_t seed)
    : Device(std::move(name), spec.model),
      spec_(spec),
      id_(id),
      seed_(mix(seed, std::string_view(this->name()))),
      guard_(limits),
      odometry_(spec.drive.radius, spec.drive.radius, spec.drive.track, spec.drive.pulses_per_turn),
      values_(spec.sensors.size()),
      lengths_(spec.sensors.size(), infinity) {
    for (std::size_t i = 0; i < spec.sensors.size(); ++i) {
        if (spec.sensors[i].kind == SensorSpec::Kind::range) range_sensors_.push_back(i);
    }
    distances_.assign(range_sensors_.size(), infinity);
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

Expected<void> Robot::add_port(const PortSpec& port) {
    if (find_port(port.name) != nullptr) return failure("is declared twice");
    if (port.items.empty()) return failure("says nothing of what it carries");
    return port.is_input ? add_input(port) : add_output(port);
}

Expected<void> Robot::add_output(const PortSpec& port) {
    const auto type = find_message_type(port.type);
    if (!type) return Unexpected(type.error());
    const std::string& item = port.items.front();
    if (item == "velocity" || item == "odometry") {
        const std::string_view expected = item == "velocity" ? "TimedVelocity2D" : "TimedPose2D";
        if (port.type != expected) return failure(fmt::format("'{}' is a {}, not a {}", item, expected, port.type));
        if (item == "velocity") {
            auto& made = add_out_port<Velocity2D>(port.name, port.doc);
            made.set_safe(std::nullopt);  // a measurement, no command
            velocity_ports_.push_back({&made, port.rate});
        } else {
            pose_ports_.push_back({&add_out_port<Pose2D>(port.name, port.doc), port.rate});
        }
        return {};
    }
    std::vector<std::size_t> sensors;
    for (const std::string& name : port.items) {
        std::vector<std::string_view> names{"velocity", "odometry"};
        std::size_t found = spec_.sensors.size();
        for (std::size_t i = 0; i < spec_.sensors.size(); ++i) {
            if (spec_.sensors[i].name == name) found = i;
            names.push_back(spec_.sensors[i].name);
        }
        if (found == spec_.sensors.size())
            return failure(fmt::format("there is no sensor '{}'{}", name, did_you_mean(name, names)));
        sensors.push_back(found);
    }
    return with_payload_type(*type, [&]<class T>() -> Expected<void> {
        constexpr WriteValues write = write_values<T>();
        if (write == nullptr) return failure(fmt::format("a {} can't carry sensors' values", port.type));
        if (single<T> && sensors.size() > 1)
            return failure(fmt::format("a {} carries one sensor, not {}", port.type, sensors.size()));
        OutPort<T>& made = add_out_port<T>(port.name, port.doc);
        bool distance = port.quantity == PortSpec::Quantity::distance;
        if constexpr (std::is_same_v<T, RangeData>) {
            distance = true;
            const SensorSpec& first = spec_.sensors[sensors.front()];
            RangeData range;
            range.geometry.pose = {.position = first.at, .orientation = {.r = 0, .p = 0, .y = first.yaw}};
            range.config = {.minAngle = 0,
                            .maxAngle = 0,
                            .angularRes = first.cone,
                            .minRange = first.minimum,
                            .maxRange = first.range,
                            .rangeRes = 0,
                            .frequency = port.rate > 0 ? port.rate : tick_rate()};
            // Both slots that writing alternates between begin with what never changes.
            made.write(range);
            made.latch({});
            made.write(range);
            made.discard();
        }
        sensor_ports_.push_back({&made, write, sensors, distance, port.rate});
        return {};
    });
}

Expected<void> Robot::add_input(const PortSpec& port) {
    if (port.items.size() != 1) return failure("goes to one thing only");
    const std::string& item = port.items.front();
    const auto is_type = [&](std::string_view type) -> Expected<void> {
        if (port.type == type) return {};
        return failure(fmt::format("'{}' takes a {}, not a {}", item, type, port.type));
    };
    if (item == "drive") {
        if (auto ok = is_type("TimedVelocity2D"); !ok) return ok;
        if (velocity_in_ != nullptr) return failure("a robot has one in-port for its drive");
        velocity_in_ = &add_in_port<Velocity2D>(port.name, port.doc, port.queue);
        return {};
    }
    if (item == "odometry") {
        if (auto ok = is_type("TimedPose2D"); !ok) return ok;
        pose_in_ = &add_in_port<Pose2D>(port.name, port.doc, port.queue);
        return {};
    }
    std::vector<std::string_view> names{"drive", "odometry"};
    for (std::size_t i = 0; i < spec_.actuators.size(); ++i) {
        const ActuatorSpec& actuator = spec_.actuators[i];
        names.push_back(actuator.name);
        if (actuator.name != item) continue;
        switch (actuator.kind) {
            case ActuatorSpec::Kind::leds:
                if (auto ok = is_type("TimedBooleanSeq"); !ok) return ok;
                leds_in_ = &add_in_port<std::vector<bool>>(port.name, port.doc, port.queue);
                leds_.assign(static_cast<std::size_t>(actuator.count), false);
                return {};
            case ActuatorSpec::Kind::buzzer:
                if (auto ok = is_type("TimedShort"); !ok) return ok;
                buzzer_in_ = &add_in_port<std::int16_t>(port.name, port.doc, port.queue);
                return {};
            case ActuatorSpec::Kind::servo:
                if (auto ok = is_type("TimedDouble"); !ok) return ok;
                servos_.push_back({&add_in_port<double>(port.name, port.doc, port.queue), i});
                return {};
            default: return failure(fmt::format("actuator '{}' is of a kind that no port drives yet", item));
        }
    }
    return failure(fmt::format("there is no actuator '{}'{}", item, did_you_mean(item, names)));
}

Expected<void> Robot::on_activated() {
    guard_.halt();
    coasting_ = spec_.drive.coasts_until_commanded;
    was_connected_ = false;
    return {};
}

bool Robot::is_due_at(double port_rate, const Time& now) const {
    return port_rate <= 0 || port_rate >= tick_rate() || nezumi::is_due(now.tick, port_rate, tick_rate());
}

double Robot::with_noise(std::size_t sensor, double value, std::int64_t tick) const {
    const double deviation = spec_.sensors[sensor].noise;
    if (deviation <= 0) return value;
    // Box and Muller (1958), from hashes of (seed, sensor, tick): no state, so any tick can be drawn again.
    const std::uint64_t hash = mix(mix(seed_, sensor), static_cast<std::uint64_t>(tick));
    const double radius = std::sqrt(-2 * std::log(uniform(hash)));
    return value + deviation * radius * std::cos(2 * std::numbers::pi * uniform(mix(hash, 1)));
}

void Robot::read_sensors(const Time& now) {
    body_->read_ranges(distances_);
    for (std::size_t i = 0; i < range_sensors_.size(); ++i) {
        const std::size_t index = range_sensors_[i];
        const SensorSpec& sensor = spec_.sensors[index];
        const double seen = distances_[i];
        lengths_[index] = seen < sensor.range ? std::max(seen, sensor.minimum) : sensor.range;
        values_[index] = sensor.has_response ? sensor.response(seen) : lengths_[index];
        if (sensor.noise > 0) {
            const double noisy = with_noise(index, values_[index], now.tick);
            values_[index] =
                sensor.has_response ? sensor.response.clamp(noisy) : std::clamp(noisy, sensor.minimum, sensor.range);
            if (!sensor.has_response) lengths_[index] = values_[index];
        }
    }
    if (range_sensors_.size() == spec_.sensors.size()) return;
    for (std::size_t i = 0; i < spec_.sensors.size(); ++i) {
        const SensorSpec& sensor = spec_.sensors[i];
        switch (sensor.kind) {
            case SensorSpec::Kind::button:
            case SensorSpec::Kind::touch: values_[i] = body_->is_pressed(i) ? 1 : 0; break;
            case SensorSpec::Kind::gyro: {
                const double measured = body_->yaw_rate();
                gyro_angle_ +=
                    (sensor.max_rate > 0 ? std::clamp(measured, -sensor.max_rate, sensor.max_rate) : measured) /
                        tick_rate() +
                    sensor.drift / tick_rate();
                values_[i] = with_noise(i, gyro_angle_, now.tick);
                break;
            }
            default: break;
        }
    }
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

    read_sensors(now);
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
            outgoing_.push_back(port.distance ? lengths_[sensor] : values_[sensor]);
        port.write(*port.port, outgoing_);
    }
}

void Robot::take_velocity(const Time& now) {
    const bool disconnected = was_connected_ && !velocity_in_->connected();
    was_connected_ = velocity_in_->connected();
    while (velocity_in_->is_new()) {
        const Velocity2D command = velocity_in_->read();
        coasting_ = false;
        switch (guard_.command(command, now.seconds)) {
            case VelocityGuard::Verdict::taken: break;
            case VelocityGuard::Verdict::clamped:
                if (!std::exchange(said_clamped_, true)) {
                    const std::string note =
                        fmt::format("limited to {} m/s and {} rad/s", guard_.limits().speed, guard_.limits().yaw_rate);
                    velocity_in_->set_note(note);
                    log(LogLevel::warn, fmt::format("input '{}': a command of {} m/s and {} rad/s was {} (said once)",
                                                    velocity_in_->name(), command.vx, command.va, note));
                }
                break;
            case VelocityGuard::Verdict::not_finite:
                if (!std::exchange(said_not_finite_, true)) {
                    log(LogLevel::warn,
                        fmt::format("input '{}': a command that is not finite stops the robot (said once)",
                                    velocity_in_->name()));
                }
                break;
        }
        if (command.vy != 0 && !std::exchange(said_sideways_, true)) {
            log(LogLevel::warn,
                fmt::format("input '{}': vy = {} m/s is ignored: two wheels can't drive sideways (said once)",
                            velocity_in_->name(), command.vy));
        }
    }
    if (disconnected) guard_.stop();
}

void Robot::drive(const Time& now) {
    if (state() == LifeState::active) {
        if (velocity_in_ != nullptr) take_velocity(now);
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

void Robot::act_on_devices(const Time& now) {
    if (pose_in_ != nullptr && pose_in_->is_new()) odometry_.set_pose(pose_in_->read());
    if (leds_in_ != nullptr && leds_in_->is_new()) {
        const std::vector<bool>& wanted = leds_in_->read();
        const std::vector<bool> before = leds_;
        for (std::size_t i = 0; i < leds_.size() && i < wanted.size(); ++i) leds_[i] = wanted[i];
        if (leds_ != before) body_->set_leds(leds_);
    }
    if (buzzer_in_ != nullptr) {
        int hertz = buzzer_hertz_;
        if (buzzer_in_->is_new()) hertz = std::max<int>(0, buzzer_in_->read());
        const double silence = now.seconds - static_cast<double>(buzzer_in_->arrival_tick()) / tick_rate();
        if (silence >= VelocityGuard::timeout) hertz = 0;
        if (hertz != std::exchange(buzzer_hertz_, hertz)) body_->set_buzzer(hertz);
    }
    for (const Servo& servo : servos_) {
        if (!servo.port->is_new()) continue;
        const ActuatorSpec& actuator = spec_.actuators[servo.actuator];
        const double angle = servo.port->read();
        if (!std::isfinite(angle)) continue;
        body_->set_servo(servo.actuator, actuator.minimum < actuator.maximum
                                             ? std::clamp(angle, actuator.minimum, actuator.maximum)
                                             : angle);
    }
}

void Robot::actuate(const Time& now) {
    drive(now);
    if (state() == LifeState::active) {
        act_on_devices(now);
    } else if (std::exchange(buzzer_hertz_, 0) != 0) {
        body_->set_buzzer(0);
    }
}

}  // namespace nezumi
