// A gamepad of Linux' event devices, read by libevdev on a thread of its own.
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

/// A job. Takes the gamepad up when it is plugged in, and again after it was unplugged.
class EvdevGamepad final : public DeviceJob {
public:
    /// `dev` stands for /dev. A device of the settings that begins with /dev/ is there.
    EvdevGamepad(const std::string& dev, const GamepadSettings& settings);

    /// How often [s] it is looked for.
    static constexpr double search_period = 1;

    /// From the control loop: what it says; nothing while there is none, or its thread hangs.
    std::optional<GamepadState> state();
    std::vector<std::string> take_faults();

    double run() override;
    int watched_file() const override;

private:
    struct Close {
        void operator()(libevdev* device) const;
    };
    using Device = std::unique_ptr<libevdev, Close>;
    // An axis, and how its numbers become -1 to 1.
    struct Axis {
        unsigned code;
        int least, most;
        double flat;    // around the middle
        double middle;  // where it rests
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
    Mutex mutex_;  // held for a copy at most
    std::optional<GamepadState> state_;
};

/// The gamepad with its thread, as a joystick wants it.
std::unique_ptr<Gamepad> open_gamepad(const std::string& dev, const GamepadSettings& settings);

}  // namespace nezumi::hw
