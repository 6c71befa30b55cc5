// One motor of the brick, as ev3dev's class tacho-motor has it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "hw/ev3/device_class.hpp"

namespace nezumi::hw {

/// Reads and writes at once: for a thread that may wait. Errors say what to do. After one, `find` comes first.
class TachoMotor {
public:
    /// `folder` of the class; `driver` as "lego-ev3-l-motor"; `port` as "outB".
    TachoMotor(const DevicePath& folder, std::string driver, std::string port);

    /// Looks for it; writes nothing.
    tl::expected<void, std::string> find();
    /// Whether it was found, and nothing has failed since.
    bool is_found() const { return nodes_.has_value(); }
    /// Of one that is found: the node that takes "stop".
    const Node& command_node() const { return nodes_->command; }

    /// Lets it roll freely, without ramps, forward positive.
    tl::expected<void, std::string> prepare();
    /// Turns at this rate [pulses/s], not 0, for `dead_man` seconds, unless told again before. Faster than the motor
    /// can is as fast as it can.
    tl::expected<void, std::string> run(int rate);
    /// Turns to a position at this rate [pulses/s; 0: as fast as it can] and holds it.
    tl::expected<void, std::string> go_to(std::int64_t position, int rate);
    /// Brakes, and holds where it stands.
    tl::expected<void, std::string> hold();
    /// Rolls freely.
    tl::expected<void, std::string> coast();

    /// Gives it up, stopped so far as it can be. Returns `why` with its port.
    std::string give_up(const std::string& why);

    /// Pulses, forward positive. One that was plugged in again counts on from where it was.
    tl::expected<std::int64_t, std::string> position();
    /// Whether it gives all its power and does not get its speed: its driver says "stalled" or "overloaded". False
    /// where the driver says nothing.
    bool is_stalled();
    const std::string& port() const { return port_; }
    int pulses_per_turn() const { return pulses_per_turn_; }

    /// [s] after which the kernel stops a motor that nobody has told again to run.
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
    DevicePath folder_{""};  // of the one that was found last
    AfterStop after_stop_ = AfterStop::unknown;
    int fastest_ = 0;  // [pulses/s]
    int pulses_per_turn_ = 360;
    std::int64_t last_ = 0;    // position, with what was counted before it was plugged in again
    std::int64_t offset_ = 0;  // of the motor's own position from it
    bool counts_anew_ = true;  // the next reading begins at `last_`
};

}  // namespace nezumi::hw
