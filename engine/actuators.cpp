// Messages become lights, tones and angles.
#include "engine/actuators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nezumi {
namespace {

using Kind = ActuatorSpec::Kind;

// The value of a port whose type `Actuators::type_for` has fixed.
template <class T>
const T& take(InPortBase& port) {
    return static_cast<InPort<T>&>(port).read();
}

}  // namespace

Actuators::Actuators(const RobotSpec& spec) : spec_(spec) {
    for (const ActuatorSpec& actuator : spec.actuators) {
        if (actuator.kind == Kind::leds) leds_.assign(static_cast<std::size_t>(actuator.count), false);
    }
}

std::string_view Actuators::type_for(Kind kind) {
    switch (kind) {
        case Kind::leds: return "TimedBooleanSeq";
        case Kind::buzzer: return "TimedShort";
        case Kind::servo: return "TimedDouble";
        default: return "";
    }
}

Expected<void> Actuators::add(std::size_t index, InPortBase& port, bool off_when_silent) {
    const ActuatorSpec& actuator = spec_.actuators[index];
    for (const Channel& channel : channels_) {
        if (channel.actuator == index)
            return failure(
                fmt::format("actuator '{}' has the in-port '{}' already", actuator.name, channel.port->name()));
    }
    if (off_when_silent && actuator.kind == Kind::servo) {
        return failure(
            fmt::format("silence = \"off\" means nothing to the servo '{}': it holds its angle", actuator.name));
    }
    channels_.push_back({index, &port, off_when_silent});
    return {};
}

void Actuators::act(RobotBody& body, const Time& now, double tick_rate) {
    for (const Channel& channel : channels_) {
        InPortBase& port = *channel.port;
        const auto arrived_at = static_cast<double>(port.arrival_tick()) / tick_rate;
        constexpr double rounding = 1e-9;
        const bool off = channel.off_when_silent && now.seconds - arrived_at >= silence - rounding;
        switch (spec_.actuators[channel.actuator].kind) {
            case Kind::leds:
                if (port.is_new()) set_leds(body, take<std::vector<bool>>(port));
                if (off) set_leds(body, std::vector<bool>(leds_.size(), false));
                break;
            case Kind::buzzer:
                if (port.is_new()) set_buzzer(body, take<std::int16_t>(port));
                if (off) set_buzzer(body, 0);
                break;
            case Kind::servo:
                if (port.is_new()) set_servo(body, channel.actuator, take<double>(port));
                break;
            default: break;
        }
    }
}

void Actuators::be_still(RobotBody& body) { set_buzzer(body, 0); }

void Actuators::set_leds(RobotBody& body, const std::vector<bool>& wanted) {
    const std::vector<bool> before = leds_;
    for (std::size_t i = 0; i < leds_.size() && i < wanted.size(); ++i) leds_[i] = wanted[i];
    if (leds_ != before) body.set_leds(leds_);
}

void Actuators::set_buzzer(RobotBody& body, int hertz) {
    hertz = std::max(0, hertz);
    if (hertz != std::exchange(buzzer_hertz_, hertz)) body.set_buzzer(hertz);
}

void Actuators::set_servo(RobotBody& body, std::size_t index, double angle) {
    if (!std::isfinite(angle)) return;
    const ActuatorSpec& servo = spec_.actuators[index];
    const bool limited = servo.minimum < servo.maximum;
    body.set_servo(index, limited ? std::clamp(angle, servo.minimum, servo.maximum) : angle);
}

}  // namespace nezumi
