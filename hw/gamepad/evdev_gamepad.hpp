// A gamepad as a Linux event device, read by libevdev on its own thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/mutex.hpp"
#include "engine/devices/joystick.hpp"
#include "hw/device/health.hpp"
#include "hw/device/worker.hpp"

struct libevdev;

namespace nezumi::hw {

/// The job of reading a gamepad. Opens the gamepad when it is plugged in, and again after it was unplugged.
class EvdevGamepad final : public DeviceJob {
public:
    /// `dev` is /dev, or the folder that replaces it, also in device paths of the settings.
    EvdevGamepad(const std::string& dev, const GamepadSettings& settings);

    /// Interval [s] of the search for the gamepad.
    static constexpr double search_period = 1;

    /// Called by the control loop: the present state, or nothing if there is no gamepad or its thread hangs.
    std::optional<GamepadState> state();
    std::vector<std::string> take_faults();

    double run() override;
    int watched_file() const override;

private:
    struct Close {
        void operator()(libevdev* device) const;
    };
    using Device = std::unique_ptr<libevdev, Close>;
    // An axis, and how its values are scaled to -1 to 1.
    struct Axis {
        unsigned code;
        int least, most;
        double flat;    // dead zone around the middle
        double middle;  // value of the released stick
        double at(int value) const;
    };

    tl::expected<Device, std::string> open(const std::string& node) const;
    tl::expected<void, std::string> find();
    tl::expected<void, std::string> take(Device device, const std::string& node);
    tl::expected<unsigned, std::string> button(const std::string& name) const;
    tl::expected<void, std::string> read_events();
    void begin_anew();
    void publish();

    const std::string folder_, wanted_, dead_man_name_, stop_name_;
    const double dead_zone_, centre_x_, centre_y_;
    Device device_;
    std::string node_;  // of device_
    std::vector<Axis> axes_;
    std::vector<unsigned> buttons_;
    std::optional<unsigned> dead_man_, stop_;
    int stops_ = 0;
    Health health_{"gamepad"};
    Mutex mutex_;  // held only for a copy
    std::optional<GamepadState> state_;
};

/// A gamepad with its thread, as a joystick component needs it.
std::unique_ptr<Gamepad> open_gamepad(const std::string& dev, const GamepadSettings& settings);

}  // namespace nezumi::hw
