// The process that stops a robot's motors when the program that drives them has ended or stalled.
#pragma once

#include <sys/types.h>

#include <span>
#include <string>

namespace nezumi::hw {

/// A write that makes something stop.
struct StopWrite {
    std::string path;
    std::string text;
};

/// What the engine says to the guard, a byte each, and the guard to the engine.
enum class GuardMessage : char {
    beat = 'b',     ///< engine: the motors have power and I am alive. Guard, as its answer to any message: so am I
    rest = 'r',     ///< engine: the motors have no power; there may be no beats now
    brake = 'k',    ///< engine: stop the motors now, I am about to end
    stopped = 's',  ///< guard: no beat came in time, or I was to brake: the motors are stopped
};

/// For how long [s] the guard waits for a beat, and the engine for its answer.
inline constexpr double beat_timeout = 0.2;

/// What the forked guard does, until its engine has ended: never returns. `socket` leads to the engine, the process
/// `engine`; `lease` is kept open. Allocates nothing: the engine's other threads were not forked.
[[noreturn]] void be_guard(int socket, int lease, pid_t engine, std::span<const StopWrite> stop_writes);

}  // namespace nezumi::hw
