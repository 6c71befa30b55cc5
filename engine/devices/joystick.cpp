// Converts the stick's position to wheel speeds.
#include "engine/devices/joystick.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "engine/base/schedule.hpp"

namespace nezumi {

Joystick::Joystick(std::string name, Open open)
    : Device(std::move(name), "Joystick"),
      open_(std::move(open)),
      stick_(add_in_port<std::vector<float>>(
          "stick", "position of the stick {x, y} [px] from the middle, y up; without messages: the middle")),
      pos_(add_out_port<std::vector<float>>("pos", "the stick's position {x, y} [px] from the middle, y up")),
      vel_(add_out_port<std::vector<float>>("vel", "left and right wheel: the stick turned by 45 degrees [px]")),
      axes_(add_out_port<std::vector<float>>("axes", "a real gamepad's axes, each -1 to 1, in the order of Linux")),
      buttons_(add_out_port<std::vector<bool>>("buttons", "a real gamepad's buttons, in the order of Linux")) {
    for (const auto& [parameter, doc] :
         {std::pair{"device", "device of a real gamepad; empty: the first one"},
          {"dead_man_button", "of a real gamepad, such as BTN_TL: its stick works only while this button is held"},
          {"stop_button", "of a real gamepad, as BTN_SELECT: an emergency stop of all robots"}}) {
        const auto ok = parameters_.declare({.name = parameter, .initial = std::string(), .doc = doc});
        assert(ok);
        static_cast<void>(ok);
    }
    const auto declare = [this](ParameterSpec spec) {
        const auto ok = parameters_.declare(std::move(spec));
        assert(ok);
        static_cast<void>(ok);
    };
    declare(
        {.name = "dead_zone",
         .initial = 0.0,
         .min = 0,
         .max = 0.9,
         .doc = "of a real gamepad: the part of a stick's way around its centre that counts as the centre; 0: what the "
                "gamepad's driver says, or 0.05 where it says nothing"});
    declare({.name = "centre",
             .initial = std::vector<double>{0, 0},
             .min = -0.9,
             .max = 0.9,
             .doc = "of a real gamepad: where its stick rests, parts of its way to the right and up",
             .min_size = 2,
             .max_size = 2});
}

GamepadSettings Joystick::settings() const {
    const auto value = [this](std::string_view name) { return parameters_.find(name)->value.get<std::string>(); };
    const auto& centre = parameters_.find("centre")->value.get<std::vector<double>>();
    return {.device = value("device"),
            .dead_man_button = value("dead_man_button"),
            .stop_button = value("stop_button"),
            .dead_zone = parameters_.find("dead_zone")->value.get<double>(),
            .centre_x = centre[0],
            .centre_y = centre[1]};
}

Expected<void> Joystick::on_activated() {
    speaks_ = false;
    return {};
}

Expected<void> Joystick::on_deactivated() {
    gamepad_.reset();
    return {};
}

// The state of the gamepad; no value if none is connected.
std::optional<GamepadState> Joystick::look() {
    if (!open_) return std::nullopt;
    if (GamepadSettings wanted = settings(); !gamepad_ || wanted != settings_) {
        gamepad_.reset();  // closed first: a device can be open only once
        settings_ = std::move(wanted);
        gamepad_ = open_(settings_);
        counted_ = 0;
    }
    for (std::string& fault : gamepad_->take_faults()) log(LogLevel::warn, std::move(fault));
    auto state = gamepad_->state();
    if (state) stops_ += state->stops - std::exchange(counted_, state->stops);
    return state;
}

void Joystick::point(double x, double y) {
    const auto on_pad = [](double px) { return std::clamp(static_cast<float>(px), -edge, edge); };
    const float right = on_pad(x), up = on_pad(y);
    constexpr float diagonal = std::numbers::sqrt2_v<float> / 2;
    pos_.write({right, up});
    vel_.write({(up + right) * diagonal, (up - right) * diagonal});
}

void Joystick::sense(const Time& now) {
    if (state() != LifeState::active) return;
    set_now(now);
    parameters_.take_staged();
    const auto gamepad = look();
    if (rate > 0 && !is_due(now.tick, rate, tick_rate(), now.left_out)) return;
    if (gamepad) {
        axes_.write(gamepad->axes);
        buttons_.write(gamepad->buttons);
    }
    if (stick_.is_new()) {
        const std::vector<float>& held = stick_.read();
        const bool is_place = held.size() >= 2 && std::isfinite(held[0]) && std::isfinite(held[1]);
        point(is_place ? held[0] : 0, is_place ? held[1] : 0);
        speaks_ = true;
    } else if (gamepad && !gamepad->is_released && !gamepad->is_stop_held) {
        point(gamepad->x * edge, gamepad->y * edge);
        speaks_ = true;
    } else if (gamepad || !open_ || speaks_) {
        // The stick was released and is in the middle again.
        point(0, 0);
        speaks_ = gamepad.has_value();
    }
}

Expected<std::unique_ptr<Component>> make_joystick(const ComponentEntry& entry, System& /*system*/) {
    return std::make_unique<Joystick>(entry.name);
}

}  // namespace nezumi
