// Converts between the values of a body and the ports of its driver.
#include "engine/robot/scripted_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

#include "engine/ports/payload.hpp"
#include "engine/robot/actuators.hpp"

namespace nezumi {
namespace {

constexpr double stale = 0.3;          // [s] older readings are not used; the same time as in C++ drivers
constexpr double speed_window = 0.05;  // [s] time over which speeds are measured
constexpr double impossible = 10;      // [m/s] no wheel is so fast: the counts began again

using Pulses = std::vector<std::int32_t>;

Wheels metres_per_pulse_of(const DriveSpec& drive) {
    const double turn = 2 * std::numbers::pi / drive.encoder_pulses();
    return {.left = turn * drive.radius_of_left(), .right = turn * drive.radius_of_right()};
}

std::string named(std::string_view prefix, std::string_view name) { return fmt::format("{}{}", prefix, name); }

template <class T>
double sensor_number(const T& value) {
    if constexpr (std::is_same_v<T, std::string>) {
        for (int color = 0;; ++color) {
            const std::string_view text = to_text(static_cast<FloorColor>(color));
            if (text.empty() || text == value || color > 7) return color > 7 ? 0 : color;
        }
    } else {
        return static_cast<double>(value);
    }
}

// The numbers in the newest message of a port with values of sensors.
std::vector<double> numbers_in(InPortBase& port) {
    return with_payload_type(*port.type(), [&]<class T>() -> std::vector<double> {
        if constexpr (std::is_same_v<T, RangeData>) {
            return static_cast<InPort<T>&>(port).read().ranges;
        } else if constexpr (Sequence<T>) {
            std::vector<double> all;
            if constexpr (std::is_arithmetic_v<typename T::value_type> ||
                          std::is_same_v<typename T::value_type, std::string>) {
                for (const auto& each : static_cast<InPort<T>&>(port).read())
                    all.push_back(sensor_number<typename T::value_type>(each));
            }
            return all;
        } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
            return {sensor_number<T>(static_cast<InPort<T>&>(port).read())};
        } else {
            return {};
        }
    });
}

bool is_driven_by_sensors(const PortSpec& port) {
    const std::string& item = port.items.front();
    return !port.is_input && item != "velocity" && item != "odometry" && item != "stalled";
}

}  // namespace

ScriptedBody::ScriptedBody(const RobotSpec& spec, Ports ports, std::unique_ptr<RobotBody> simulated)
    : spec_(spec),
      simulated_(std::move(simulated)),
      actuators_(spec.actuators.size()),
      angles_(spec.actuators.size()),
      readings_(spec.sensors.size()),
      values_(spec.sensors.size()) {
    const auto add_in = [&]<class T>(std::string_view name, const char* doc, T*) {
        auto port = std::make_unique<InPort<T>>(named(to_driver, name), doc);
        auto* made = port.get();
        ports.in.push_back(std::move(port));
        return made;
    };
    pulses_in_ =
        add_in(wheel_pulses, "by the driver: encoder pulses of the left and right wheel, counted from any zero",
               static_cast<Pulses*>(nullptr));
    may_drive_in_ = add_in(may_drive_port, "by the driver: false brakes the robot, as for a low battery",
                           static_cast<bool*>(nullptr));
    for (const PortSpec& port : spec.ports) {
        const std::string& item = port.items.front();
        if (item == "drive") {
            auto made = std::make_unique<OutPort<Velocity2D>>(named(to_driver, port.name),
                                                              "for the driver: the commanded velocity, after limits");
            commanded_ = made.get();
            ports.out.push_back(std::move(made));
        } else if (item == "velocity" && velocity_in_ == nullptr) {
            velocity_in_ = add_in(port.name, "by the driver: the measured velocity", static_cast<Velocity2D*>(nullptr));
        } else if (port.type == "NeighbourSeq" || item == "say") {
            // Neighbours exist only in simulation, so these ports bypass the driver.
        } else if (is_driven_by_sensors(port)) {
            add_sensor_port(port, ports);
        } else if (port.is_input && item != "odometry") {
            const auto actuator = std::find_if(spec.actuators.begin(), spec.actuators.end(),
                                               [&](const ActuatorSpec& each) { return each.name == item; });
            auto made = make_out_port(*find_message_type(port.type), named(to_driver, port.name),
                                      "for the driver: the command for the actuator");
            actuators_[static_cast<std::size_t>(actuator - spec.actuators.begin())] = made.get();
            ports.out.push_back(std::move(made));
        }
    }
    was_told_.resize(sensed_.size());
    if (simulated_ != nullptr) add_model_ports(ports);
}

void ScriptedBody::add_sensor_port(const PortSpec& port, Ports ports) {
    Sensed sensed{.port = nullptr,
                  .sensors = {},
                  .physical = port.quantity != PortSpec::Quantity::value || port.type == "RangeData",
                  .first = 0,
                  .count = 0};
    for (const std::string& name : port.items) {
        const auto found = std::find_if(spec_.sensors.begin(), spec_.sensors.end(),
                                        [&](const SensorSpec& each) { return each.name == name; });
        sensed.sensors.push_back(static_cast<std::size_t>(found - spec_.sensors.begin()));
    }
    const SensorSpec& first = spec_.sensors[sensed.sensors.front()];
    if (first.kind == SensorSpec::Kind::scan) sensed.count = static_cast<std::size_t>(first.rays);
    if (first.kind == SensorSpec::Kind::imu) {
        const bool is_half = port.quantity != PortSpec::Quantity::value;
        sensed.count = is_half ? 3 : 6;
        sensed.first = port.quantity == PortSpec::Quantity::acceleration ? 3 : 0;
    }
    auto made = make_in_port(*find_message_type(port.type), named(to_driver, port.name),
                             "by the driver: the measured values", 0);
    sensed.port = made.get();
    ports.in.push_back(std::move(made));
    sensed_.push_back(std::move(sensed));
}

void ScriptedBody::add_model_ports(Ports ports) {
    auto pulses = std::make_unique<OutPort<Pulses>>(named(to_model, wheel_pulses),
                                                    "for the device model: pulses of the simulated encoders");
    model_pulses_ = pulses.get();
    ports.out.push_back(std::move(pulses));
    for (const SensorSpec& sensor : spec_.sensors) {
        if (sensor.kind == SensorSpec::Kind::neighbours) {
            model_sensors_.push_back(nullptr);
            continue;
        }
        const bool has_several = sensor.kind == SensorSpec::Kind::scan || sensor.kind == SensorSpec::Kind::imu;
        model_sensors_.push_back(
            ports.out
                .emplace_back(make_out_port(*find_message_type(has_several ? "TimedDoubleSeq" : "TimedDouble"),
                                            named(to_model, sensor.name), "for the device model: the simulated sensor"))
                .get());
    }
    for (const PortSpec& port : spec_.ports) {
        if (port.items.front() != "drive") continue;
        auto drive = std::make_unique<InPort<Velocity2D>>(named(to_model, port.name),
                                                          "by the device model: drives the simulated wheels");
        model_drive_ = drive.get();
        ports.in.push_back(std::move(drive));
    }
}

void ScriptedBody::forget(const Component& gone) {
    // A robot without its driver, or without one of the devices, does not drive.
    for (Needed& needed : needed_) {
        if (needed.part == &gone) needed = {nullptr, [] { return false; }};
    }
}

bool ScriptedBody::needs(const Component& part) const {
    return std::any_of(needed_.begin(), needed_.end(), [&](const Needed& each) { return each.part == &part; });
}

bool ScriptedBody::may_drive() const {
    if (may_drive_in_->count() > 0 && !may_drive_in_->value().get<bool>()) return false;
    return std::all_of(needed_.begin(), needed_.end(), [](const Needed& each) { return each.works(); });
}

void ScriptedBody::take_pulses(const Time& now) {
    if (!pulses_in_->is_new()) return;
    const Pulses& counts = pulses_in_->read();
    const double tm = pulses_in_->tm();
    if (counts.size() != 2) {
        if (!std::exchange(said_pulses_, true))
            faults_.push_back(
                fmt::format("{}: expected the pulses of two wheels, left and right, got {} (reported once)",
                            pulses_in_->name(), counts.size()));
        counted_.reset();
        return;
    }
    const Wheels metres = metres_per_pulse_of(spec_.drive);
    if (counted_) {
        // The counts may overflow.
        const auto passed = [&](std::size_t i) {
            return static_cast<std::int32_t>(static_cast<std::uint32_t>(counts[i]) -
                                             static_cast<std::uint32_t>((*counted_)[i]));
        };
        const std::int32_t left = passed(0), right = passed(1);
        const double most = impossible * std::max(now.seconds - wheels_.tm, 1e-3);
        if (std::abs(left * metres.left) <= most && std::abs(right * metres.right) <= most) {
            wheels_.pulses.left += left;
            wheels_.pulses.right += right;
        } else {
            faults_.emplace_back("the wheels' pulses jumped: the odometry ignores the jump");
            counts_.clear();
        }
    }
    counted_ = counts;
    wheels_.is_there = true;
    wheels_.tm = tm;
    counts_.push_back({tm, wheels_.pulses});
    while (counts_.size() > 2 && tm - counts_[1].tm >= speed_window) counts_.pop_front();
    const double passed = counts_.back().tm - counts_.front().tm;
    const auto speed = [&](std::int64_t WheelPulses::*wheel, double each) {
        return passed > 0
                   ? static_cast<double>(counts_.back().pulses.*wheel - counts_.front().pulses.*wheel) * each / passed
                   : 0;
    };
    wheels_.speeds = {.left = speed(&WheelPulses::left, metres.left),
                      .right = speed(&WheelPulses::right, metres.right)};
}

// For a driver that writes velocities, not pulses: integrates the velocities and converts the way to pulses.
void ScriptedBody::take_velocity(const Time& /*now*/, double period) {
    if (velocity_in_ == nullptr || counted_) return;
    if (velocity_in_->is_new()) {
        const Velocity2D& velocity = velocity_in_->read();
        const double turn = velocity.va * spec_.drive.track / 2;
        wheels_.speeds = {.left = velocity.vx - turn, .right = velocity.vx + turn};
        wheels_.tm = velocity_in_->tm();
        wheels_.is_there = true;
    }
    if (!wheels_.is_there) return;
    const Wheels metres = metres_per_pulse_of(spec_.drive);
    travelled_.left += wheels_.speeds.left * period;
    travelled_.right += wheels_.speeds.right * period;
    wheels_.pulses = {.left = std::llround(travelled_.left / metres.left),
                      .right = std::llround(travelled_.right / metres.right)};
}

WheelReading ScriptedBody::read_wheels(const Time& now, double period) {
    if (simulated_ != nullptr) show_model(now, period);
    take_pulses(now);
    take_velocity(now, period);
    if (wheels_.is_there && now.seconds - wheels_.tm > stale) {
        wheels_.is_there = false;
        wheels_.speeds = {};
        counts_.clear();
    }
    return wheels_;
}

void ScriptedBody::take(const Sensed& sensed) {
    std::vector<double> numbers = numbers_in(*sensed.port);
    const std::size_t expected = sensed.count > 0 ? sensed.count : sensed.sensors.size();
    const auto index = static_cast<std::size_t>(&sensed - sensed_.data());
    if (numbers.size() != expected) {
        if (!was_told_[index])
            faults_.push_back(fmt::format("{}: expected {} values, got {} (reported once)", sensed.port->name(),
                                          expected, numbers.size()));
        was_told_[index] = true;
        return;
    }
    for (std::size_t i = 0; i < sensed.sensors.size(); ++i) {
        SensorReading& reading = readings_[sensed.sensors[i]];
        const SensorSpec& spec = spec_.sensors[sensed.sensors[i]];
        reading.is_there = true;
        reading.tm = sensed.port->tm();
        if (sensed.count > 0) continue;
        if (!sensed.physical || spec.kind != SensorSpec::Kind::gyro) reading.value = numbers[i];
        if (sensed.physical || !spec.has_response) reading.physical = numbers[i];
        if (sensed.physical && spec.has_response) reading.value = spec.response(numbers[i]);
    }
    if (sensed.count == 0) return;
    std::vector<double>& all = values_[sensed.sensors.front()];
    all.resize(std::max(all.size(), spec_.sensors[sensed.sensors.front()].kind == SensorSpec::Kind::imu
                                        ? std::size_t{6}
                                        : sensed.count));
    std::copy(numbers.begin(), numbers.end(), all.begin() + static_cast<std::ptrdiff_t>(sensed.first));
}

std::span<const SensorReading> ScriptedBody::read_sensors(const Time& now, double /*period*/) {
    for (const Sensed& sensed : sensed_) {
        if (sensed.port->is_new()) take(sensed);
    }
    for (SensorReading& reading : readings_) reading.is_there = reading.is_there && now.seconds - reading.tm <= stale;
    return readings_;
}

void ScriptedBody::show_model(const Time& now, double period) {
    const WheelReading wheels = simulated_->read_wheels(now, period);
    model_pulses_->write(
        {static_cast<std::int32_t>(wheels.pulses.left), static_cast<std::int32_t>(wheels.pulses.right)});
    const auto readings = simulated_->read_sensors(now, period);
    for (std::size_t i = 0; i < readings.size(); ++i) {
        if (model_sensors_[i] == nullptr) continue;
        const std::span<const double> values = simulated_->sensor_values(i);
        if (!values.empty()) {
            static_cast<OutPort<std::vector<double>>&>(*model_sensors_[i]).write({values.begin(), values.end()});
        } else {
            static_cast<OutPort<double>&>(*model_sensors_[i]).write(readings[i].value);
        }
    }
    // If the device model writes nothing for a time, the simulated wheels stop.
    if (model_drive_ == nullptr) return;
    const bool is_silent =
        model_drive_->arrival_tick() < 0 || now.seconds - model_drive_->arrived_at() > nezumi::silence;
    const Velocity2D velocity = is_silent ? Velocity2D{} : model_drive_->read();
    const double turn = velocity.va * spec_.drive.track / 2;
    simulated_->set_wheel_speeds({.left = velocity.vx - turn, .right = velocity.vx + turn});
}

std::vector<std::string> ScriptedBody::take_faults() { return std::exchange(faults_, {}); }

double ScriptedBody::servo_angle(std::size_t index) const {
    return simulated_ != nullptr ? simulated_->servo_angle(index) : angles_[index];
}

void ScriptedBody::set_wheel_speeds(Wheels speeds) {
    if (commanded_ == nullptr) return;
    commanded_->write(
        {.vx = (speeds.left + speeds.right) / 2, .vy = 0, .va = (speeds.right - speeds.left) / spec_.drive.track});
}

void ScriptedBody::aim_servo(std::size_t index, double angle, double speed) {
    angles_[index] = angle;
    if (actuators_[index] != nullptr) static_cast<OutPort<double>&>(*actuators_[index]).write(angle);
    if (simulated_ != nullptr) simulated_->aim_servo(index, angle, speed);
}

OutPortBase* ScriptedBody::actuator_port(ActuatorSpec::Kind kind, std::optional<std::size_t> index) const {
    for (std::size_t i = 0; i < actuators_.size(); ++i) {
        if (actuators_[i] != nullptr && spec_.actuators[i].kind == kind && (!index || *index == i))
            return actuators_[i];
    }
    return nullptr;
}

void ScriptedBody::set_leds(const std::vector<bool>& on) {
    if (auto* port = actuator_port(ActuatorSpec::Kind::leds)) static_cast<OutPort<std::vector<bool>>&>(*port).write(on);
    if (simulated_ != nullptr) simulated_->set_leds(on);
}

void ScriptedBody::set_buzzer(int hertz) {
    if (auto* port = actuator_port(ActuatorSpec::Kind::buzzer))
        static_cast<OutPort<std::int16_t>&>(*port).write(static_cast<std::int16_t>(std::min(hertz, 32767)));
    if (simulated_ != nullptr) simulated_->set_buzzer(hertz);
}

void ScriptedBody::show(std::size_t index, const CameraImage& picture) {
    if (auto* port = actuator_port(ActuatorSpec::Kind::screen, index))
        static_cast<OutPort<CameraImage>&>(*port).write(picture);
}

}  // namespace nezumi
