// The process that stops a robot's motors when the program that drives them ends or stalls.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "hw/guard/guard_setup.hpp"

namespace nezumi::hw {

/// How a guard proves that it could stop a node, without stopping it (docs/hardware.md describes it for each driver).
enum class Proof : std::uint8_t {
    none,         ///< no proof is needed, because the motion ends on its own
    is_there,     ///< the file of the guard's descriptor has not been removed
    empty_write,  ///< like `is_there`, and the node's driver accepts a write of no bytes
};

/// A message from the engine to the guard, one packet each. Only `node` orders contain the member `node`, and carry a
/// descriptor, open for writing, for the guard.
struct GuardOrder {
    enum class Kind : std::uint8_t {
        beat,   ///< the motors have power or will have it, and the control loop is alive at `tm`
        rest,   ///< the motors have no power; beats may pause
        node,   ///< from now on also stop this node, which replaces the node with the same index
        brake,  ///< stop all nodes, now and at each further beat: the engine is about to end
    };
    Kind kind = Kind::beat;
    double tm = 0;  ///< [s] by the engine's `clock_seconds`
    struct Node {
        std::uint8_t index = 0;
        Proof proof = Proof::none;
        std::array<char, 8> text{};    ///< the text that stops it, zero-terminated
        std::array<char, 512> path{};  ///< the path used if its descriptor does not work, zero-terminated
    } node{};

    static constexpr std::size_t most_nodes = 4;
};

/// A message from the guard to the engine.
struct GuardAnswer {
    enum class Kind : std::uint8_t {
        proved,    ///< answer to a beat: all nodes can be stopped
        unproved,  ///< answer to a beat: the node `index` can't be stopped because of `error`
        stopped,   ///< the motors are stopped: no beat came in time, or the engine is about to end
    };
    Kind kind = Kind::proved;
    double tm = 0;  ///< of the beat
    std::uint8_t index = 0;
    int error = 0;  ///< `errno`
};

/// Time [s] that the guard waits for a beat, and that a proof is valid.
inline constexpr double beat_timeout = 0.2;

/// The guard's main function: runs until the engine has ended, and never returns. `socket` leads to the engine.
/// `engine`: the engine's process. `words`: the memory of its command line. `lease` is kept open. Allocates nothing,
/// because the engine's other threads do not exist after the fork, and one of them may have locked the memory.
[[noreturn]] void be_guard(int socket, int lease, pid_t engine, const ProcessWords& words);

}  // namespace nezumi::hw
