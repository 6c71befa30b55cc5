// A joystick: publishes the position of its stick at its rate, also if it has not moved.
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

/// Selects a gamepad and the functions of two of its buttons, by their names in Linux ("BTN_TL"); "" for none.
struct GamepadSettings {
    std::string device;  ///< device file of the gamepad; "": the first one found
    std::string dead_man_button;
    std::string stop_button;
    double dead_zone = 0;  ///< part of a stick's range around its centre that counts as 0; 0: the default of its driver
    double centre_x = 0;   ///< position of the stick at rest, relative to its range; right and up are positive
    double centre_y = 0;
    bool operator==(const GamepadSettings&) const = default;
};

/// The state of a gamepad.
struct GamepadState {
    double x = 0, y = 0;        ///< of its stick, -1 to 1, right and up positive
    std::vector<float> axes;    ///< each axis, -1 to 1, in the order of their codes
    std::vector<bool> buttons;  ///< whether each is pressed, in the order of their codes
    bool is_released = false;   ///< a dead-man button is set and not pressed: the stick counts as centred
    bool is_stop_held = false;  ///< the button for emergency stops is pressed
    int stops = 0;              ///< how often the button for emergency stops has been pressed
};

/// A real gamepad, which is read in the background.
class Gamepad {
public:
    virtual ~Gamepad() = default;
    /// The present state; nothing if no gamepad is connected. Never waits.
    virtual std::optional<GamepadState> state() = 0;
    /// The faults since the last call: one line each, with what to do.
    virtual std::vector<std::string> take_faults() = 0;
};

/// A joystick. Messages to the in-port `stick` move the stick: from arrow keys of a prompt, a browser's pad, or another
/// component. Without a message since the last tick, the position is that of the gamepad, or the middle. The pad is 300
/// x 300 px.
class Joystick final : public Device {
public:
    using Open = std::function<std::unique_ptr<Gamepad>(const GamepadSettings&)>;

    /// `open` is called on activation, and again after a parameter has changed. Without `open` there is no gamepad.
    /// With `open`, while no gamepad is connected and the stick is not moved, the ports publish nothing, after one
    /// message for the middle.
    explicit Joystick(std::string name, Open open = nullptr);

    static constexpr float edge = 150;  ///< [px] from the middle of the pad

    void sense(const Time& now) override;
    void actuate(const Time& /*now*/) override {}

    /// How often the emergency stop button of the gamepad has been pressed.
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
    int counted_ = 0;      // presses of the open gamepad that `stops_` includes
    bool speaks_ = false;  // the middle must still be published before the ports fall silent
};

/// The factory of components of type Joystick without a gamepad.
Expected<std::unique_ptr<Component>> make_joystick(const ComponentEntry& entry, System& system);

}  // namespace nezumi
