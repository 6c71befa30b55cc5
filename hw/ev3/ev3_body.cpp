// Assigns the brick's devices to the sensors and actuators of the robot file, and converts their units.
#include "hw/ev3/ev3_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nezumi::hw {
namespace {

using SensorKind = SensorSpec::Kind;

constexpr double degree = std::numbers::pi / 180;

// The mode to read a sensor of this kind; nothing for the brick's buttons, and for kinds that an EV3 does not have.
std::optional<SensorMode> mode_of(SensorKind kind) {
    switch (kind) {
        case SensorKind::touch: return SensorMode{"lego-ev3-touch", "TOUCH"};
        case SensorKind::range: return SensorMode{"lego-ev3-us", "US-DIST-CM"};
        case SensorKind::gyro: return SensorMode{"lego-ev3-gyro", "GYRO-G&A", 2};
        case SensorKind::color:
        case SensorKind::reflect: return SensorMode{"lego-ev3-color", "RGB-RAW", 3};
        case SensorKind::ambient: return SensorMode{"lego-ev3-color", "COL-AMBIENT"};
        case SensorKind::button:
        case SensorKind::scan:
        case SensorKind::imu:
        case SensorKind::neighbours: return std::nullopt;
    }
    return std::nullopt;
}

bool is_color(SensorKind kind) { return kind == SensorKind::color || kind == SensorKind::reflect; }

// For each sensor of the spec, the number of its device. Colour sensors at the same port are one device with one
// number.
std::vector<std::size_t> devices_of(const RobotSpec& spec) {
    std::vector<std::size_t> first(spec.sensors.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        first[i] = i;
        for (std::size_t other = 0; other < i; ++other) {
            const SensorSpec &a = spec.sensors[other], &b = spec.sensors[i];
            if (is_color(a.kind) && is_color(b.kind) && a.port == b.port) first[i] = first[other];
        }
    }
    return first;
}

bool has_color(const RobotSpec& spec) {
    return std::any_of(spec.sensors.begin(), spec.sensors.end(), [](const auto& each) { return is_color(each.kind); });
}

std::optional<std::size_t> servo_of(const RobotSpec& spec) {
    for (std::size_t i = 0; i < spec.actuators.size(); ++i) {
        if (spec.actuators[i].kind == ActuatorSpec::Kind::servo) return i;
    }
    return std::nullopt;
}

std::optional<std::size_t> key_of(const SensorSpec& sensor) {
    const auto key = std::find(brick_keys.begin(), brick_keys.end(), sensor.port);
    if (sensor.kind != SensorKind::button || key == brick_keys.end()) return std::nullopt;
    return static_cast<std::size_t>(key - brick_keys.begin());
}

Expected<void> check(const RobotSpec& spec) {
    const auto servos = std::count_if(spec.actuators.begin(), spec.actuators.end(), [](const ActuatorSpec& actuator) {
        return actuator.kind == ActuatorSpec::Kind::servo;
    });
    if (servos > 1)
        return failure(fmt::format("the driver ev3 has one servo, but model '{}' needs {}", spec.model, servos));
    if (!spec.drive.port.empty() && spec.drive.port.size() != 2)
        return failure(fmt::format("drive.port of model '{}': expected two, the left motor's and the right's, got {}",
                                   spec.model, spec.drive.port.size()));
    for (const SensorSpec& sensor : spec.sensors) {
        if (sensor.kind == SensorKind::button && !key_of(sensor))
            return failure(fmt::format("sensor '{}' of model '{}': port: expected a key of the brick, {}, got '{}'",
                                       sensor.name, spec.model, fmt::join(brick_keys, ", "), shown(sensor.port)));
    }
    const auto devices = devices_of(spec);
    for (std::size_t i = 0; i < devices.size(); ++i) {
        for (std::size_t other = 0; other < i; ++other) {
            const SensorSpec &a = spec.sensors[other], &b = spec.sensors[i];
            if (devices[i] == devices[other] || !mode_of(a.kind) || !mode_of(b.kind)) continue;
            const bool same_device = a.kind == b.kind && (a.port.empty() || b.port.empty());
            if (!same_device && (a.port.empty() || a.port != b.port)) continue;
            return failure(
                fmt::format("the driver ev3 can't tell '{}' and '{}' of model '{}' apart: give each a port = "
                            "\"in1\" to \"in4\" of its own",
                            a.name, b.name, spec.model));
        }
    }
    return {};
}

std::vector<DevicePath> led_nodes(const DevicePath& sys) {
    std::vector<DevicePath> nodes;
    for (const char* led : {"led0:red", "led0:green", "led1:red", "led1:green"})
        nodes.push_back(sys + fmt::format("/class/leds/{}:brick-status/brightness", led));
    return nodes;
}

}  // namespace

double GyroAngle::take(const SensorValues& values) {
    const int angle = static_cast<int>(values.values[0]);
    if (values.plugged_in == plugged_in_ && last_) degrees_ -= static_cast<std::int16_t>(angle - *last_);
    plugged_in_ = values.plugged_in;
    last_ = angle;
    return degrees_ * degree;
}

std::optional<Rgb> floor_seen(const SensorValues& values) {
    constexpr double white = 300, least = 8;
    if (*std::max_element(values.values.begin(), values.values.end()) < least) return std::nullopt;
    Rgb color = 0;
    for (const double value : values.values)
        color = color << 8 | static_cast<Rgb>(std::lround(std::clamp(value / white, 0.0, 1.0) * 255));
    return color;
}

Expected<std::unique_ptr<RobotBody>> Ev3Body::make(const RobotSpec& spec, const DeviceRoots& roots) {
    if (auto ok = check(spec); !ok) return Unexpected(ok.error());
    const DevicePath motors = roots.in_sys() + "/class/tacho-motor";
    std::array<std::string, WheelMotors::count> ports{"outB", "outC"};
    if (!spec.drive.port.empty()) std::copy(spec.drive.port.begin(), spec.drive.port.end(), ports.begin());
    auto wheels = WheelMotors::make(motors, ports, rim_acceleration(spec.drive) / metres_per_pulse(spec.drive).left);
    if (!wheels) return Unexpected(wheels.error());
    const auto index = servo_of(spec);
    std::unique_ptr<ServoMotor> servo;
    if (index) {
        const ActuatorSpec& actuator = spec.actuators[*index];
        servo = std::make_unique<ServoMotor>(motors, actuator.port.empty() ? "outA" : actuator.port,
                                             fmt::format("motor '{}'", actuator.name), (*wheels)->guard());
    }
    return std::unique_ptr<RobotBody>(
        new Ev3Body(spec, roots, std::move(*wheels), std::move(servo), index.value_or(spec.actuators.size())));
}

Ev3Body::Ev3Body(const RobotSpec& spec, const DeviceRoots& roots, std::unique_ptr<WheelMotors> wheels,
                 std::unique_ptr<ServoMotor> servo, std::size_t servo_index)
    : spec_(spec),
      readings_(spec.sensors.size()),
      channel_of_(spec.sensors.size(), nullptr),
      servo_index_(servo_index),
      loudspeaker_(spec),
      wheels_(std::move(wheels)),
      lights_(std::make_unique<Lights>(led_nodes(roots.in_sys()), "255", with_ev3_advice)),
      screen_(std::make_unique<BrickScreen>(roots.in_dev() + "/fb0", roots.in_sys() + "/class/graphics/fb0")),
      battery_(std::make_unique<Battery>(roots.in_sys() + "/class/power_supply")) {
    if (servo) servo_.emplace(std::move(servo));
    for (std::size_t i = 0; i < spec.sensors.size(); ++i) {
        if (const auto key = key_of(spec.sensors[i])) keys_of_.emplace_back(i, *key);
    }
    if (!keys_of_.empty()) keys_.emplace(std::make_unique<BrickKeys>(roots.in_dev()));
    add_sensors(roots.in_sys() + "/class/lego-sensor");
}

void Ev3Body::add_sensors(const DevicePath& folder) {
    const auto devices = devices_of(spec_);
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const SensorSpec& sensor = spec_.sensors[i];
        const auto mode = mode_of(sensor.kind);
        // Next to a colour sensor, ambient light is not measured: it is another mode of the same sensor.
        if (!mode || (sensor.kind == SensorKind::ambient && has_color(spec_))) continue;
        if (devices[i] == i) {
            channels_.push_back(std::make_unique<RunningJob<ModeSensor>>(
                std::make_unique<ModeSensor>(fmt::format("sensor '{}'", sensor.name), folder, *mode, sensor.port)));
            channel_of_[i] = channels_.back().get();
        } else {
            channel_of_[i] = channel_of_[devices[i]];
        }
    }
}

WheelReading Ev3Body::read_wheels(const Time& now, double /*period*/) {
    const auto sample = wheels_->newest(clock_.look(now));
    return wheel_reading(sample, clock_, now, spec_.drive);
}

// True if another touch sensor has been found. Then this one is not plugged in, and is read as not pressed.
bool Ev3Body::is_touch_elsewhere(std::size_t sensor) const {
    for (std::size_t i = 0; i < channel_of_.size(); ++i) {
        if (i != sensor && spec_.sensors[i].kind == SensorKind::touch && (*channel_of_[i])->was_there()) return true;
    }
    return false;
}

void Ev3Body::read(std::size_t sensor, const SensorValues& values) {
    const SensorSpec& spec = spec_.sensors[sensor];
    SensorReading& reading = readings_[sensor];
    const double first = values.values[0];
    switch (spec.kind) {
        case SensorKind::range:
            reading.physical = std::clamp(first / 100, spec.minimum, spec.range);
            reading.value = spec.has_response ? spec.response(reading.physical) : reading.physical;
            break;
        case SensorKind::gyro:
            reading.value = gyro_.take(values);
            reading.physical = -values.values[1] * degree;
            break;
        case SensorKind::color: {
            const auto seen = floor_seen(values);
            reading.value = static_cast<double>(seen ? nearest_floor_color(*seen) : FloorColor::none);
            break;
        }
        case SensorKind::reflect: {
            const auto seen = floor_seen(values);
            reading.value = seen ? brightness(*seen) : 0;
            break;
        }
        case SensorKind::touch:
        case SensorKind::ambient:
        case SensorKind::button: reading.value = first; break;
        case SensorKind::scan:
        case SensorKind::imu:
        case SensorKind::neighbours: break;  // not on a brick
    }
}

std::span<const SensorReading> Ev3Body::read_sensors(const Time& now, double /*period*/) {
    const double clock = clock_.look(now);
    for (std::size_t i = 0; i < readings_.size(); ++i) {
        SensorReading& reading = readings_[i];
        reading.is_there = false;
        if (channel_of_[i] == nullptr) continue;
        const RunningJob<ModeSensor>& device = *channel_of_[i];
        if (const auto sample = device->newest(clock)) {
            reading.is_there = true;
            reading.tm = clock_.system_time(now, sample->tm);
            read(i, sample->value);
        } else if (spec_.sensors[i].kind == SensorKind::touch && !device->was_there() && is_touch_elsewhere(i)) {
            reading = {.is_there = true, .tm = now.seconds};
        }
    }
    if (keys_) read_keys(now, clock);
    return readings_;
}

void Ev3Body::read_keys(const Time& now, double clock) {
    const auto sample = (*keys_)->newest(clock);
    for (const auto& [sensor, key] : keys_of_) {
        SensorReading& reading = readings_[sensor];
        reading.is_there = sample.has_value();
        if (!sample) continue;
        reading.tm = clock_.system_time(now, sample->tm);
        reading.value = sample->value[key] ? 1 : 0;
    }
}

double Ev3Body::servo_angle(std::size_t index) const {
    return servo_ && index == servo_index_ ? (*servo_)->angle() : 0;
}

std::vector<std::string> Ev3Body::take_faults() {
    std::vector<std::string> all = wheels_->take_faults();
    if (servo_) append(all, (*servo_)->take_faults());
    for (const auto& channel : channels_) append(all, (*channel)->take_faults());
    append(all, lights_->take_faults());
    append(all, screen_->take_faults());
    append(all, battery_->take_faults());
    if (keys_) append(all, (*keys_)->take_faults());
    append(all, loudspeaker_.take_faults());
    return all;
}

void Ev3Body::set_wheel_speeds(Wheels speeds) {
    const Wheels metres = metres_per_pulse(spec_.drive);
    wheels_->command({.drives = may_have_power_,
                      .rates = {.left = speeds.left / metres.left, .right = speeds.right / metres.right}});
    wheels_.wake();
}

void Ev3Body::coast() {
    wheels_->command({});
    wheels_.wake();
}

void Ev3Body::set_motor_power(bool on) {
    may_have_power_ = on;
    if (!on) coast();
}

void Ev3Body::aim_servo(std::size_t index, double angle, double speed) {
    if (!servo_ || index != servo_index_) return;
    (*servo_)->aim(angle, speed);
    servo_->wake();
}

void Ev3Body::set_leds(const std::vector<bool>& on) {
    lights_->set(on);
    lights_.wake();
}

void Ev3Body::show(std::size_t /*index*/, const CameraImage& picture) {
    screen_->show(picture);
    screen_.wake();
}

}  // namespace nezumi::hw
