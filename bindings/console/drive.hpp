// Drives with the arrow keys: a stick whose place on its pad is sent every tick.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "bindings/console/session.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// The pad of robots.md: 300 x 300 px, y up, (0, 0) in the middle. Terminals tell no release of a key: the stick goes
/// back to the middle when no key came for `springs_back`.
class Drive {
public:
    static constexpr double edge = 150;           ///< [px] from the middle
    static constexpr double notch = 50;           ///< [px] that one press moves it
    static constexpr double springs_back = 0.7;   ///< [s] of simulated time; a keyboard's repeat begins sooner
    static constexpr double speed_of_px = 0.002;  ///< [m/s / px] into a velocity port
    static constexpr double turn_of_px = -0.02;   ///< [rad/s / px]
    /// What a stick at the edge gives, as a share of what it gives at first; a pad ends at 1.
    static constexpr std::array scales{0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0};

    /// From now on holds "name.port", or of a joystick its in-port `stick`, of another component its out-port `pos`, of
    /// a robot its velocity in-port. The port carries a sequence of numbers or a velocity.
    Expected<void> begin(RunningSystem& live, const std::string& what, const Actor& who);
    bool is_on() const { return !path_.empty() && !ending_; }
    /// "name.port" that it holds.
    const std::string& path() const { return path_; }
    /// What the stick sends at its edge: "0.30 m/s, 3.0 rad/s".
    std::string full_speed() const;
    void key(Key key, RunningSystem& live);
    /// The stick goes to the middle, and the port is let go after the next tick.
    void end(RunningSystem& live);
    /// After every tick. The error says why it has ended: its port is gone, or another took it.
    Expected<void> after_tick(RunningSystem& live);

private:
    Expected<void> send(RunningSystem& live);

    Actor who_;
    std::string path_;
    double x_ = 0;
    double y_ = 0;
    std::size_t scale_ = 0;  // of `scales`
    bool is_velocity_ = false;
    double sent_x_ = 0;
    double sent_y_ = 0;
    double pressed_at_ = 0;
    bool ending_ = false;
};

}  // namespace nezumi
