// A joystick: where its stick is, published at its rate whether or not it moved.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/components/component.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

class System;

/// Which gamepad, and what two of its buttons are for: their names in Linux ("BTN_TL"), "" for none.
struct GamepadSettings {
    std::string device;  ///< its node; "": the first there is
    std::string dead_man_button;
    std::string stop_button;
    double dead_zone = 0;  ///< part of a stick's way around its centre that counts as 0; 0: as its driver says
    double centre_x = 0;   ///< where the stick rests, a part of its way, right and up positive
    double centre_y = 0;
    bool operator==(const GamepadSettings&) const = default;
};

/// What a gamepad says.
struct GamepadState {
    double x = 0, y = 0;        ///< of its stick, -1 to 1, right and up positive
    std::vector<float> axes;    ///< each axis, -1 to 1, in the order of their codes
    std::vector<bool> buttons;  ///< whether each is pressed, in the order of their codes
    bool is_released = false;   ///< the dead-man button, where there is one, is not held: its stick counts as centred
    bool is_stop_held = false;  ///< the button for emergency stops is pressed
    int stops = 0;              ///< how often that button has been pressed
};

/// A real gamepad, read beside the loop.
class Gamepad {
public:
    virtual ~Gamepad() = default;
    /// What it says now; nothing while none is plugged in. Never waits.
    virtual std::optional<GamepadState> state() = 0;
    /// What has failed since the last call: one line for each with what to do about it.
    virtual std::vector<std::string> take_faults() = 0;
};

/// Who sends to its in-port `stick` holds the stick: a prompt's arrow keys, a browser's pad, another component. When
/// nothing has come since it was read last, it is where a gamepad has it, or else back in the middle. The pad is
/// 300 x 300 px.
class Joystick final : public Device {
public:
    using Open = std::function<std::unique_ptr<Gamepad>(const GamepadSettings&)>;

    /// `open` is called on activation, and again when a parameter has changed. Without it there is no gamepad. With it,
    /// while none is plugged in and nobody holds the stick, the ports are silent, after one message from the middle.
    explicit Joystick(std::string name, Open open = nullptr);

    static constexpr float edge = 150;  ///< [px] from the middle of the pad

    void sense(const Time& now) override;
    void actuate(const Time& /*now*/) override {}

    /// How often its gamepad's button for emergency stops has been pressed.
    int stops() const { return stops_; }
    bool take_stop() override { return std::exchange(told_stops_, stops_) < stops_; }

private:
    Expected<void> on_activated() override;
    Expected<void> on_deactivated() override;
    GamepadSettings settings() const;
    std::optional<GamepadState> look();
    void point(double x, double y);

    Open open_;
    InPort<std::vector<float>>& stick_;  // {x, y} [px] from the middle, y up
    OutPort<std::vector<float>>& pos_;   // {x, y} [px] from the middle, y up
    OutPort<std::vector<float>>& vel_;   // {left, right} wheel, the stick turned by 45 degrees
    OutPort<std::vector<float>>& axes_;
    OutPort<std::vector<bool>>& buttons_;
    GamepadSettings settings_;
    std::unique_ptr<Gamepad> gamepad_;
    int stops_ = 0;
    int told_stops_ = 0;
    int counted_ = 0;      // of them by the gamepad that is open
    bool speaks_ = false;  // its last message was not the one that ends them
};

/// The maker of components of type Joystick without a gamepad.
Expected<std::unique_ptr<Component>> make_joystick(const ComponentEntry& entry, System& system);

}  // namespace nezumi
