// Channels of the mouse's devices to sensors of its description, and the clock's time to the system's.
#include "hw/raspimouse/mouse_body.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hw/raspimouse/advice.hpp"
#include "hw/raspimouse/codec.hpp"

namespace nezumi::hw {
namespace {

std::vector<std::string> led_nodes(const std::string& folder) {
    std::vector<std::string> nodes(4);
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = fmt::format("{}/rtled{}", folder, i);
    return nodes;
}

}  // namespace

// Responses fall with the distance, or rise: halving finds the place either way.
double distance_at(const ResponseTable& response, double value) {
    double near = 0, far = response.range();
    const double at_near = response(near), at_far = response(far);
    const bool falls = at_near > at_far;
    if (falls ? value <= at_far : value >= at_far) return far;
    if (falls ? value >= at_near : value <= at_near) return near;
    for (int i = 0; i < 40; ++i) {
        const double middle = (near + far) / 2;
        ((response(middle) > value) == falls ? near : far) = middle;
    }
    return far;
}

Expected<std::unique_ptr<RobotBody>> MouseBody::make(const RobotSpec& spec, const DeviceRoots& roots) {
    const auto count = [&](SensorSpec::Kind kind) {
        return std::count_if(spec.sensors.begin(), spec.sensors.end(),
                             [&](const SensorSpec& sensor) { return sensor.kind == kind; });
    };
    if (count(SensorSpec::Kind::range) > 4 || count(SensorSpec::Kind::button) > 3)
        return failure(fmt::format(
            "the driver raspimouse has 4 distance sensors and 3 buttons, and model '{}' wants more", spec.model));
    auto motors = Motors::make(roots.dev, metres_per_pulse(spec.drive), rim_acceleration(spec.drive));
    if (!motors) return Unexpected(motors.error());
    return std::unique_ptr<RobotBody>(new MouseBody(spec, roots.dev, std::move(*motors)));
}

MouseBody::MouseBody(const RobotSpec& spec, const std::string& folder, std::shared_ptr<Motors> motors)
    : spec_(spec),
      readings_(spec.sensors.size()),
      motors_(std::move(motors)),
      counters_(std::make_shared<WheelCounters>(folder, motors_->commanded())),
      light_sensors_(std::make_shared<LightSensors>(folder)),
      switches_(std::make_shared<Switches>(folder)),
      lights_(std::make_shared<Lights>(led_nodes(folder), encode_switch(true), with_advice)),
      loudspeaker_(spec),
      motors_worker_(motors_),
      counters_worker_(counters_),
      light_sensors_worker_(light_sensors_),
      switches_worker_(switches_),
      lights_worker_(lights_) {
    for (std::size_t i = 0; i < spec.sensors.size(); ++i) {
        if (spec.sensors[i].kind == SensorSpec::Kind::range) ranges_.push_back(i);
        if (spec.sensors[i].kind == SensorSpec::Kind::button) buttons_.push_back(i);
    }
}

WheelReading MouseBody::read_wheels(const Time& now, double /*period*/) {
    const auto sample = counters_->newest(clock_.look(now));
    return wheel_reading(sample, clock_, now, spec_.drive);
}

std::span<const SensorReading> MouseBody::read_sensors(const Time& now, double /*period*/) {
    const double clock = clock_.look(now);
    const auto lights = light_sensors_->newest(clock);
    for (std::size_t channel = 0; channel < ranges_.size(); ++channel) {
        SensorReading& reading = readings_[ranges_[channel]];
        reading.is_there = lights.has_value();
        if (!lights) continue;
        reading.tm = clock_.system_time(now, lights->tm);
        const int value = lights->value[channel];
        if (value == converted_[channel] && reading.physical > 0) continue;
        converted_[channel] = value;
        const SensorSpec& sensor = spec_.sensors[ranges_[channel]];
        reading.value = sensor.has_response ? sensor.response.clamp(value) : value;
        reading.physical = sensor.has_response ? distance_at(sensor.response, reading.value) : value;
    }
    const auto switches = switches_->newest(clock);
    for (std::size_t channel = 0; channel < buttons_.size(); ++channel) {
        SensorReading& reading = readings_[buttons_[channel]];
        reading.is_there = switches.has_value();
        if (!switches) continue;
        reading.tm = clock_.system_time(now, switches->tm);
        reading.value = switches->value[channel] ? 1 : 0;
    }
    return readings_;
}

std::vector<std::string> MouseBody::take_faults() {
    std::vector<std::string> all = motors_->take_faults();
    append(all, counters_->take_faults());
    append(all, light_sensors_->take_faults());
    append(all, switches_->take_faults());
    append(all, lights_->take_faults());
    append(all, loudspeaker_.take_faults());
    return all;
}

void MouseBody::send() {
    motors_->command(command_);
    motors_worker_.wake();
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
    lights_worker_.wake();
}

void MouseBody::set_buzzer(int hertz) {
    command_.tone = hertz;
    send();
}

}  // namespace nezumi::hw
