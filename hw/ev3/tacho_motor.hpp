// A motor of ev3dev's class tacho-motor.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "hw/ev3/device_class.hpp"

namespace nezumi::hw {

/// Reads and writes device files directly, so use it on a thread that may block. Errors say what to do. After an error,
/// call `find` again.
class TachoMotor {
public:
    /// `folder`: of the class; `driver`: such as "lego-ev3-l-motor"; `port`: such as "outB".
    TachoMotor(const DevicePath& folder, std::string driver, std::string port);

    /// Finds the motor. Writes nothing.
    tl::expected<void, std::string> find();
    /// True if the motor was found and no access has failed since.
    bool is_found() const { return nodes_.has_value(); }
    /// The node that takes "stop". The motor must have been found.
    const Node& command_node() const { return nodes_->command; }

    /// Releases the motor and sets it up: no ramps, forward positive.
    tl::expected<void, std::string> prepare();
    /// Turns at `rate` [pulses/s], not 0, for `dead_man` seconds, unless called again. The motor's maximum limits the
    /// rate.
    tl::expected<void, std::string> run(int rate);
    /// Turns to a position at this rate [pulses/s; 0: the fastest] and holds it.
    tl::expected<void, std::string> go_to(std::int64_t position, int rate);
    /// Brakes and holds the position.
    tl::expected<void, std::string> hold();
    /// Releases the motor: it rolls freely.
    tl::expected<void, std::string> coast();

    /// Stops the motor as far as possible and marks it as lost. Returns `why` with its port.
    std::string give_up(const std::string& why);

    /// The position [pulses], forward positive. It continues after the motor was plugged in again.
    tl::expected<std::int64_t, std::string> position();
    /// True if the motor gives full power but does not reach its speed: its driver reports "stalled" or "overloaded".
    /// False if the driver does not report this.
    bool is_stalled();
    const std::string& port() const { return port_; }
    int pulses_per_turn() const { return pulses_per_turn_; }

    /// Time [s] after which the kernel stops a motor unless the command is repeated.
    static constexpr double dead_man = 0.2;

private:
    enum class AfterStop { unknown, hold, coast };
    struct Nodes {
        explicit Nodes(const DevicePath& folder);
        Node command, speed, target, time, after_stop, position, state;
    };
    tl::expected<void, std::string> write(Node& node, const std::string& text);
    tl::expected<void, std::string> set_after_stop(AfterStop wanted);

    DeviceClass class_;
    const std::string driver_, port_;
    std::optional<Nodes> nodes_;
    DevicePath folder_{""};  // of the motor that was last found
    AfterStop after_stop_ = AfterStop::unknown;
    int fastest_ = 0;  // [pulses/s]
    int pulses_per_turn_ = 360;
    std::int64_t last_ = 0;    // position, including the counts before it was plugged in again
    std::int64_t offset_ = 0;  // of the motor's own position
    bool counts_anew_ = true;  // the next reading corresponds to `last_`
};

}  // namespace nezumi::hw
