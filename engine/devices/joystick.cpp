// The stick's place, and the wheels' speeds that it stands for.
#include "engine/devices/joystick.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/base/schedule.hpp"

namespace nezumi {

Joystick::Joystick(std::string name)
    : Device(std::move(name), "Joystick"),
      stick_(
          add_in_port<std::vector<float>>("stick", "where the stick is held {x, y} [px]; in the middle while silent")),
      pos_(add_out_port<std::vector<float>>("pos", "the stick's place {x, y} [px] from the middle, y up")),
      vel_(add_out_port<std::vector<float>>("vel", "left and right wheel: the stick turned by 45 degrees [px]")) {
    const auto ok = parameters_.declare(
        {.name = "device", .initial = std::string(), .doc = "a real gamepad's device; empty: the stick on the screen"});
    assert(ok);
    static_cast<void>(ok);
}

void Joystick::sense(const Time& now) {
    if (state() != LifeState::active) return;
    set_now(now);
    parameters_.take_staged();
    if (rate > 0 && !is_due(now.tick, rate, tick_rate())) return;
    // Nobody holds it: it has sprung back.
    static const std::vector<float> middle{0, 0};
    const std::vector<float>& held = stick_.is_new() ? stick_.read() : middle;
    const bool is_place = held.size() >= 2 && std::isfinite(held[0]) && std::isfinite(held[1]);
    const auto on_pad = [](float px) { return std::clamp(px, -edge, edge); };
    const float x = is_place ? on_pad(held[0]) : 0, y = is_place ? on_pad(held[1]) : 0;
    constexpr float diagonal = std::numbers::sqrt2_v<float> / 2;
    pos_.write({x, y});
    vel_.write({(y + x) * diagonal, (y - x) * diagonal});
}

Expected<std::unique_ptr<Component>> make_joystick(const ComponentEntry& entry, System& /*system*/) {
    return std::make_unique<Joystick>(entry.name);
}

}  // namespace nezumi
