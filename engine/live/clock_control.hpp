// The time of a running system as the console's commands drive it: what the loop that runs the ticks lends to the
// console.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/log.hpp"

namespace nezumi {

/// Of a speed: simulated seconds a second.
inline constexpr double slowest_speed = 0.001, fastest_speed = 1e6;
/// As a speed: ticks follow each other without waiting.
inline constexpr double as_fast_as_possible = std::numeric_limits<double>::infinity();

/// The bounds of time, whoever asks: a command line, a console, a browser. Errors say what was expected.
Expected<double> check_speed(double factor);
Expected<std::int64_t> check_ticks(double ticks);

/// Implemented by the loop that runs the ticks; called between two ticks, from the thread that runs them. What may not
/// be done on hardware (`speed`, `step`, `run`, `restart`) the console refuses itself, by `is_hardware`.
class ClockControl {
public:
    virtual ~ClockControl() = default;

    /// Real robots move: `--hw`.
    virtual bool is_hardware() const = 0;

    /// No ticks pass until `resume` or `advance`. On hardware the robots are stopped.
    virtual void pause() = 0;
    /// Ticks pass again, at `speed`.
    virtual void resume() = 0;
    virtual bool is_paused() const = 0;

    /// Lets so many ticks pass from now on, at `speed`, and pauses then. `pause` and `resume` end it early; another
    /// `advance` begins anew.
    virtual void advance(std::int64_t ticks) = 0;
    /// Ticks of an `advance` are still to come.
    virtual bool is_advancing() const = 0;
    /// How often `pause`, `resume` and `advance` have been called: another number, and somebody has taken time over.
    virtual std::uint64_t moves() const = 0;

    /// As `check_speed` gave it.
    virtual void set_speed(double factor) = 0;
    virtual double speed() const = 0;

    /// Ends the run in good order, soon after this returns.
    virtual void quit() = 0;

    /// The latest warnings and errors of the log, oldest first.
    virtual std::vector<LogLine> problems() const = 0;
};

}  // namespace nezumi
