// Drives with the arrow keys: they move a virtual stick, whose position is sent every tick.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "bindings/console/session.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// The joystick's pad: 300 x 300 px, y up, (0, 0) in the middle. Terminals do not report the release of a key, so the
/// stick returns to the middle if no key came for `springs_back`.
class Drive {
public:
    static constexpr double edge = 150;           ///< [px] from the middle
    static constexpr double notch = 50;           ///< [px] for one press
    static constexpr double springs_back = 0.7;   ///< [s] of simulated time; longer than a keyboard's repeat delay
    static constexpr double speed_of_px = 0.002;  ///< [m/s / px] for a velocity port
    static constexpr double turn_of_px = -0.02;   ///< [rad/s / px]
    /// Factors of the value at the edge. The joystick's own pad sends at most 1.
    static constexpr std::array scales{0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0};

    /// Starts to hold a port: "name.port", or the in-port `stick` of a joystick, the out-port `pos` of another
    /// component, or the velocity in-port of a robot. The port must carry a sequence of numbers or a velocity.
    Expected<void> begin(RunningSystem& live, const std::string& what, const Actor& who);
    bool is_on() const { return !path_.empty() && !ending_; }
    /// The held port as "name.port".
    const std::string& path() const { return path_; }
    /// The value at full deflection, as in "0.30 m/s, 3.0 rad/s".
    std::string full_speed() const;
    void key(Key key, RunningSystem& live);
    /// The stick goes to the middle, and the port is released after the next tick.
    void end(RunningSystem& live);
    /// Call this after every tick. The error says why driving has ended: the port is gone, or is held by another actor.
    Expected<void> after_tick(RunningSystem& live);

private:
    Expected<void> send(RunningSystem& live);

    Actor who_;
    std::string path_;
    double x_ = 0;
    double y_ = 0;
    std::size_t scale_ = 0;  // index into `scales`
    bool is_velocity_ = false;
    double sent_x_ = 0;
    double sent_y_ = 0;
    double pressed_at_ = 0;
    bool ending_ = false;
};

}  // namespace nezumi
