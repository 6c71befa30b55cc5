// Converts messages to lights, tones, angles, pictures and sounds.
#include "engine/robot/actuators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/world/sound.hpp"

namespace nezumi {
namespace {

using Kind = ActuatorSpec::Kind;

// The value of a port; `Actuators::type_for` has determined its type.
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
        case Kind::screen: return "CameraImage";
        case Kind::speaker: return "TimedString";
    }
    return "";
}

Expected<void> Actuators::add(std::size_t index, InPortBase& port, bool off_when_silent) {
    const ActuatorSpec& actuator = spec_.actuators[index];
    for (const Channel& channel : channels_) {
        if (channel.actuator == index)
            return failure(
                fmt::format("actuator '{}' has the in-port '{}' already", actuator.name, channel.port->name()));
    }
    if (off_when_silent && actuator.kind != Kind::leds && actuator.kind != Kind::buzzer) {
        const auto [kind, why] = actuator.kind == Kind::servo    ? std::pair("servo", "it holds its angle")
                                 : actuator.kind == Kind::screen ? std::pair("screen", "it keeps its last picture")
                                                                 : std::pair("speaker", "it is silent after each text");
        return failure(fmt::format("silence = \"off\" has no meaning for the {} '{}': {}", kind, actuator.name, why));
    }
    channels_.push_back(
        {.actuator = index, .port = &port, .off_when_silent = off_when_silent, .speed = actuator.speed});
    return {};
}

void Actuators::set_servo_speed(std::size_t index, double speed) {
    for (Channel& channel : channels_) {
        if (channel.actuator == index) channel.speed = speed;
    }
}

void Actuators::act(RobotBody& body, const Time& now, const std::function<void(std::string)>& warn) {
    is_still_ = false;
    for (Channel& channel : channels_) {
        InPortBase& port = *channel.port;
        const bool off = channel.off_when_silent && port.is_silent(now.seconds);
        switch (spec_.actuators[channel.actuator].kind) {
            case Kind::leds:
                if (port.is_new()) set_leds(body, take<std::vector<bool>>(port));
                if (off) set_leds(body, std::vector<bool>(leds_.size(), false));
                break;
            case Kind::buzzer:
                if (port.is_new()) {
                    const int hertz = take<std::int16_t>(port);
                    if (!is_stopped_) set_buzzer(body, hertz);
                }
                if (off) set_buzzer(body, 0);
                break;
            case Kind::servo:
                if (port.is_new()) {
                    const double angle = take<double>(port);
                    if (!is_stopped_) aim_servo(body, channel, angle);
                }
                break;
            case Kind::screen:
                while (port.is_new()) show(body, channel, warn);
                break;
            case Kind::speaker:
                while (port.is_new()) {
                    const std::string& text = take<std::string>(port);
                    if (!is_stopped_) play(body, text);
                }
                break;
        }
    }
}

void Actuators::be_still(RobotBody& body) {
    set_buzzer(body, 0);
    if (std::exchange(is_still_, true)) return;
    hold_servos(body);
    body.silence();
}

void Actuators::hold_servos(RobotBody& body) {
    for (Channel& channel : channels_) {
        if (spec_.actuators[channel.actuator].kind == Kind::servo)
            aim_servo(body, channel, body.servo_angle(channel.actuator));
    }
}

void Actuators::stop(RobotBody* body) {
    is_stopped_ = true;
    if (body == nullptr) return;
    hold_servos(*body);
    set_buzzer(*body, 0);
    body->silence();
}

void Actuators::rearm() {
    is_stopped_ = false;
    for (const Channel& channel : channels_) {
        const Kind kind = spec_.actuators[channel.actuator].kind;
        if (kind == Kind::servo || kind == Kind::buzzer || kind == Kind::speaker) channel.port->clear();
    }
}

void Actuators::set_leds(RobotBody& body, const std::vector<bool>& wanted) {
    const std::vector<bool> before = leds_;
    for (std::size_t i = 0; i < leds_.size() && i < wanted.size(); ++i) leds_[i] = wanted[i];
    if (leds_ != before) body.set_leds(leds_);
}

void Actuators::set_buzzer(RobotBody& body, int hertz) {
    hertz = std::max(0, hertz);
    if (hertz != std::exchange(buzzer_hertz_, hertz)) body.set_buzzer(hertz);
}

// Ignores an angle that is not finite.
void Actuators::aim_servo(RobotBody& body, Channel& channel, double angle) const {
    const ActuatorSpec& servo = spec_.actuators[channel.actuator];
    if (!std::isfinite(angle)) return;
    if (servo.minimum < servo.maximum) angle = std::clamp(angle, servo.minimum, servo.maximum);
    if (angle != std::exchange(channel.angle, angle)) body.aim_servo(channel.actuator, angle, channel.speed);
}

void Actuators::show(RobotBody& body, Channel& channel, const std::function<void(std::string)>& warn) {
    const CameraImage& picture = take<CameraImage>(*channel.port);
    const std::size_t bits = std::size_t{picture.width} * picture.height * picture.bpp;
    const std::size_t bytes = (bits + 7) / 8;
    if (bits > 0 && picture.pixels.size() == bytes) {
        body.show(channel.actuator, picture);
    } else if (!std::exchange(channel.has_warned, true)) {
        const std::string expected = bits > 0 ? fmt::format("{} bytes", bytes)
                                              : "width, height and bpp (bits per pixel, 24 for rgb8) greater than 0";
        warn(fmt::format(
            "input '{}': can't show a picture of {} x {} pixels with {} bits per pixel and {} bytes (reported once): "
            "expected {}",
            channel.port->name(), picture.width, picture.height, picture.bpp, picture.pixels.size(), expected));
    }
}

void Actuators::play(RobotBody& body, const std::string& text) {
    said_.push_back(text);
    if (said_.size() > most_said) said_.pop_front();
    if (const Sound sound = read_sound(text); sound.kind != Sound::Kind::nothing) body.play(sound);
}

}  // namespace nezumi
