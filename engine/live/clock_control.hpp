// Controls the time of a running system, for the commands of the console. The loop that runs the ticks implements it.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/log.hpp"

namespace nezumi {

/// The limits of a speed: simulated seconds per real second.
inline constexpr double slowest_speed = 0.001, fastest_speed = 1e6;
/// The speed for ticks without waiting.
inline constexpr double as_fast_as_possible = std::numeric_limits<double>::infinity();

/// The most ticks that one command lets pass.
inline constexpr double most_ticks = 1e12;

/// Checks limits of time for command lines, consoles and browsers. The error says what was expected.
Expected<double> check_speed(double factor);
Expected<std::int64_t> check_ticks(double ticks);

/// The interface of the loop that runs the ticks, for calls between two ticks in the thread of the loop. The console
/// itself refuses commands that are not allowed on hardware (`speed`, `step`, `run`, `restart`), by `is_hardware`.
class ClockControl {
public:
    virtual ~ClockControl() = default;

    /// Whether real robots move (`--hw`).
    virtual bool is_hardware() const = 0;

    /// In simulation no ticks pass until `resume` or `advance`. Real robots stop and stand, and their time continues.
    virtual void pause() = 0;
    /// Ticks pass again, at `speed`.
    virtual void resume() = 0;
    virtual bool is_paused() const = 0;

    /// Lets `ticks` ticks pass, at `speed`, and then pauses. `pause` and `resume` end the advance early; another
    /// `advance` replaces it.
    virtual void advance(std::int64_t ticks) = 0;
    /// Whether ticks of `advance` are left.
    virtual bool is_advancing() const = 0;
    /// Number of calls of `pause`, `resume` and `advance`: if it changes, another user controls time.
    virtual std::uint64_t moves() const = 0;

    /// Sets the speed; `check_speed` must have accepted the factor.
    virtual void set_speed(double factor) = 0;
    virtual double speed() const = 0;

    /// Ends the run normally, soon after this returns.
    virtual void quit() = 0;

    /// The latest warnings and errors of the log, oldest first.
    virtual std::vector<LogLine> problems() const = 0;
};

}  // namespace nezumi
