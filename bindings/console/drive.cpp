// Holds the position of the stick on a port.
#include "bindings/console/drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "engine/devices/joystick.hpp"

namespace nezumi {
namespace {

// The message for a port of this type at this stick position; nothing if such a port can't be driven.
std::optional<Value> payload(const MessageType* type, double x, double y) {
    if (type == message_of<std::vector<float>>())
        return Value{std::vector<float>{static_cast<float>(x), static_cast<float>(y)}};
    if (type == message_of<std::vector<double>>()) return Value{std::vector<double>{x, y}};
    if (type == message_of<Velocity2D>())
        return Value{Velocity2D{.vx = y * Drive::speed_of_px, .va = 0.0 + x * Drive::turn_of_px}};
    return std::nullopt;
}

// The port of a component that the stick drives.
std::string port_to_drive(const Component& component) {
    if (dynamic_cast<const Joystick*>(&component) != nullptr) return component.name() + ".stick";
    if (const Port* pos = component.find_out_port("pos")) return component.name() + "." + pos->name();
    const auto fits = [](const auto& port) { return port->type() == message_of<Velocity2D>(); };
    if (dynamic_cast<const Robot*>(&component) != nullptr) {
        const auto& ports = component.in_ports();
        if (const auto in = std::find_if(ports.begin(), ports.end(), fits); in != ports.end())
            return component.name() + "." + (*in)->name();
    }
    const auto& ports = component.out_ports();
    if (const auto out = std::find_if(ports.begin(), ports.end(), fits); out != ports.end())
        return component.name() + "." + (*out)->name();
    return "";
}

constexpr std::size_t usual_scale = 5;
static_assert(Drive::scales[usual_scale] == 1);

double press(double place, double by) {
    if (place * by < 0) return 0;  // a key of the opposite direction first sets 0
    return std::clamp(place + by, -Drive::edge, Drive::edge);
}

}  // namespace

Expected<void> Drive::begin(RunningSystem& live, const std::string& what, const Actor& who) {
    std::string path = what;
    if (what.find('.') == std::string::npos) {
        const auto component = live.system().component(what);
        if (!component) return Unexpected(component.error());
        path = port_to_drive(**component);
        if (path.empty()) return failure(fmt::format("{} has no port to drive with: name one, as \"name.port\"", what));
    }
    const auto port = live.system().port(path);
    if (!port) return Unexpected(port.error());
    if (!payload((*port)->type(), 0, 0)) {
        return failure(fmt::format("{} is {}: drive needs a port of TimedFloatSeq, TimedDoubleSeq or TimedVelocity2D",
                                   path, (*port)->type_name()));
    }
    path_ = path;
    who_ = who;
    x_ = y_ = 0;
    scale_ = usual_scale;
    is_velocity_ = (*port)->type() == message_of<Velocity2D>();
    ending_ = false;
    if (auto held = send(live); !held) {
        path_.clear();
        return held;
    }
    return {};
}

Expected<void> Drive::send(RunningSystem& live) {
    const auto port = live.system().port(path_);
    if (!port) return failure("the driven port is gone");
    const Actor* holder = live.system().holder(path_);
    const bool has_it = holder != nullptr && *holder == who_ && (*port)->override() == Override::held;
    const double x = x_ * scales[scale_], y = y_ * scales[scale_];
    if (has_it && sent_x_ == x && sent_y_ == y) return {};
    auto value = payload((*port)->type(), x, y);
    if (!value) return failure("the driven port is gone");
    if (auto held = live.act(Hold{path_, std::move(*value)}, who_); !held)
        return failure("driving has ended: " + held.error().message);
    sent_x_ = x;
    sent_y_ = y;
    return {};
}

void Drive::key(Key key, RunningSystem& live) {
    if (!is_on()) return;
    pressed_at_ = live.system().now().seconds;
    switch (key) {
        case Key::up: y_ = press(y_, notch); break;
        case Key::down: y_ = press(y_, -notch); break;
        case Key::right: x_ = press(x_, notch); break;
        case Key::left: x_ = press(x_, -notch); break;
        case Key::space: x_ = y_ = 0; break;
        case Key::faster:
            if (scale_ + 1 < scales.size() && (is_velocity_ || scales[scale_] < 1)) ++scale_;
            break;
        case Key::slower:
            if (scale_ > 0) --scale_;
            break;
        case Key::escape: return end(live);
    }
    static_cast<void>(send(live));  // a port that is gone is reported after the tick
}

std::string Drive::full_speed() const {
    const double px = edge * scales[scale_];
    if (!is_velocity_) return fmt::format("{:.0f} px", px);
    return fmt::format("{:.2f} m/s, {:.1f} rad/s", px * speed_of_px, px * -turn_of_px);
}

void Drive::end(RunningSystem& live) {
    if (path_.empty()) return;
    x_ = y_ = 0;
    ending_ = true;
    static_cast<void>(send(live));
}

Expected<void> Drive::after_tick(RunningSystem& live) {
    if (path_.empty()) return {};
    if (ending_) {
        static_cast<void>(live.act(Release{path_}, who_));  // fails only if the port is gone: then nothing is held
        path_.clear();
        return {};
    }
    const double now = live.system().now().seconds;
    if (now - pressed_at_ > springs_back || now < pressed_at_) x_ = y_ = 0;
    auto sent = send(live);
    if (!sent) path_.clear();
    return sent;
}

}  // namespace nezumi
