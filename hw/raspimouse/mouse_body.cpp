// Assigns the mouse's devices to the sensors of the robot file, and converts their times to the system's time.
#include "hw/raspimouse/mouse_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hw/raspimouse/advice.hpp"
#include "hw/raspimouse/codec.hpp"

namespace nezumi::hw {
namespace {

std::vector<DevicePath> mouse_led_nodes(const DevicePath& folder) {
    constexpr int count = 4;
    std::vector<DevicePath> nodes;
    nodes.reserve(count);
    for (int i = 0; i < count; ++i) nodes.push_back(folder + fmt::format("/rtled{}", i));
    return nodes;
}

}  // namespace

Expected<std::vector<MouseBody::Wired>> MouseBody::wire(const RobotSpec& spec, SensorSpec::Kind kind,
                                                        std::string_view port_begin, std::size_t devices) {
    std::vector<Wired> wired;
    std::vector<std::string> ports;
    for (std::size_t channel = 0; channel < devices; ++channel)
        ports.push_back(fmt::format("{}{}", port_begin, channel));
    std::vector<bool> is_taken(devices, false);
    for (const bool has_port : {true, false}) {
        for (std::size_t i = 0; i < spec.sensors.size(); ++i) {
            const SensorSpec& sensor = spec.sensors[i];
            if (sensor.kind != kind || sensor.port.empty() == has_port) continue;
            const auto found = has_port ? std::find(ports.begin(), ports.end(), sensor.port) - ports.begin()
                                        : std::find(is_taken.begin(), is_taken.end(), false) - is_taken.begin();
            const auto channel = static_cast<std::size_t>(found);
            if (has_port && channel == devices)
                return failure(fmt::format("sensor '{}' of model '{}': port: expected one of {}, got '{}'", sensor.name,
                                           spec.model, fmt::join(ports, ", "), shown(sensor.port)));
            if (channel == devices)
                return failure(
                    fmt::format("the driver raspimouse has 4 distance sensors and 3 buttons, but model '{}' needs more",
                                spec.model));
            if (is_taken[channel])
                return failure(fmt::format("sensor '{}' of model '{}': port: another sensor has '{}' already",
                                           sensor.name, spec.model, sensor.port));
            is_taken[channel] = true;
            wired.push_back({i, channel});
        }
    }
    return wired;
}

Expected<std::unique_ptr<RobotBody>> MouseBody::make(const RobotSpec& spec, const DeviceRoots& roots) {
    if (!spec.drive.port.empty())
        return failure(
            fmt::format("drive.port of model '{}' has no meaning for the driver raspimouse: leave it out", spec.model));
    for (const ActuatorSpec& actuator : spec.actuators) {
        if (!actuator.port.empty() && actuator.kind != ActuatorSpec::Kind::speaker)
            return failure(fmt::format(
                "port of actuator '{}' of model '{}' has no meaning for the driver raspimouse: leave it out",
                actuator.name, spec.model));
    }
    auto ranges = wire(spec, SensorSpec::Kind::range, "", 4);
    if (!ranges) return Unexpected(ranges.error());
    auto buttons = wire(spec, SensorSpec::Kind::button, "rtswitch", 3);
    if (!buttons) return Unexpected(buttons.error());
    auto motors = Motors::make(roots.in_dev(), metres_per_pulse(spec.drive), rim_acceleration(spec.drive));
    if (!motors) return Unexpected(motors.error());
    return std::unique_ptr<RobotBody>(
        new MouseBody(spec, roots, std::move(*motors), std::move(*ranges), std::move(*buttons)));
}

MouseBody::MouseBody(const RobotSpec& spec, const DeviceRoots& roots, std::unique_ptr<Motors> motors,
                     std::vector<Wired> ranges, std::vector<Wired> buttons)
    : spec_(spec),
      ranges_(std::move(ranges)),
      buttons_(std::move(buttons)),
      readings_(spec.sensors.size()),
      loudspeaker_(spec),
      motors_(std::move(motors)),
      counters_(std::make_unique<WheelCounters>(roots.in_dev(), motors_->commanded())),
      light_sensors_(std::make_unique<LightSensors>(roots.in_dev())),
      switches_(std::make_unique<Switches>(roots.in_dev())),
      lights_(std::make_unique<Lights>(mouse_led_nodes(roots.in_dev()), encode_switch(true), with_mouse_advice)),
      supply_(std::make_unique<Supply>(roots.in_sys() + "/class/hwmon")) {}

WheelReading MouseBody::read_wheels(const Time& now, double /*period*/) {
    const auto sample = counters_->newest(clock_.look(now));
    return wheel_reading(sample, clock_, now, spec_.drive);
}

std::span<const SensorReading> MouseBody::read_sensors(const Time& now, double /*period*/) {
    const double clock = clock_.look(now);
    const auto lights = light_sensors_->newest(clock);
    for (Wired& range : ranges_) {
        SensorReading& reading = readings_[range.sensor];
        reading.is_there = lights.has_value();
        if (!lights) continue;
        reading.tm = clock_.system_time(now, lights->tm);
        const int value = lights->value[range.channel];
        if (value == range.converted && reading.physical > 0) continue;
        range.converted = value;
        const SensorSpec& sensor = spec_.sensors[range.sensor];
        reading.value = sensor.has_response ? sensor.response.clamp(value) : value;
        reading.physical = sensor.has_response ? distance_at(sensor.response, reading.value) : value;
    }
    const auto switches = switches_->newest(clock);
    for (const Wired& button : buttons_) {
        SensorReading& reading = readings_[button.sensor];
        reading.is_there = switches.has_value();
        if (!switches) continue;
        reading.tm = clock_.system_time(now, switches->tm);
        reading.value = switches->value[button.channel] ? 1 : 0;
    }
    return readings_;
}

std::vector<std::string> MouseBody::take_faults() {
    std::vector<std::string> all = motors_->take_faults();
    append(all, counters_->take_faults());
    append(all, light_sensors_->take_faults());
    append(all, switches_->take_faults());
    append(all, lights_->take_faults());
    append(all, supply_->take_faults());
    append(all, loudspeaker_.take_faults());
    return all;
}

void MouseBody::send() {
    motors_->command(command_);
    motors_.wake();
}

void MouseBody::set_wheel_speeds(Wheels speeds) {
    command_.speeds = speeds;
    command_.power = may_have_power_;
    send();
}

void MouseBody::coast() {
    command_.speeds = {};
    command_.power = false;
    send();
}

void MouseBody::set_motor_power(bool on) {
    may_have_power_ = on;
    if (on) return;
    command_.power = false;
    send();
}

void MouseBody::set_leds(const std::vector<bool>& on) {
    lights_->set(on);
    lights_.wake();
}

void MouseBody::set_buzzer(int hertz) {
    command_.tone = hertz;
    send();
}

}  // namespace nezumi::hw
