// The process that stops a robot's motors when the program that drives them has ended or stalled.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace nezumi::hw {

/// How a guard proves that it could write to a node, without writing anything to it (docs/hardware.md has what each
/// driver makes of it).
enum class Proof : std::uint8_t {
    none,         ///< not at all: what the node moves ends by itself
    is_there,     ///< the guard's descriptor is of a node that has not been removed
    empty_write,  ///< and the node's driver takes a write of no bytes through it
};

/// What the engine says to the guard: a packet each. Of all but a `node` only what comes before its member; with a
/// `node` comes a descriptor, open for writing, of the guard's own.
struct GuardOrder {
    enum class Kind : std::uint8_t {
        beat,   ///< the motors have power, or shall have it, and the control loop is alive at `tm`
        rest,   ///< the motors have no power; there may be no beats now
        node,   ///< stop this node as well, in place of the one that had its index before
        brake,  ///< stop all nodes, now and at each beat that still comes: the engine is about to end
    };
    Kind kind = Kind::beat;
    double tm = 0;  ///< [s] by the engine's `clock_seconds`
    struct Node {
        std::uint8_t index = 0;
        Proof proof = Proof::none;
        std::array<char, 8> text{};    ///< what makes it stop, up to a zero
        std::array<char, 512> path{};  ///< where it is looked for when its descriptor does not work, up to a zero
    } node{};

    static constexpr std::size_t most_nodes = 4;
};

/// What the guard says to the engine.
struct GuardAnswer {
    enum class Kind : std::uint8_t {
        proved,    ///< to a beat: I can stop all nodes
        unproved,  ///< to a beat: I can't stop the node `index`, for the reason `error`
        stopped,   ///< no beat came in time, or the engine is about to end: the motors are stopped
    };
    Kind kind = Kind::proved;
    double tm = 0;  ///< the beat's
    std::uint8_t index = 0;
    int error = 0;  ///< `errno`
};

/// For how long [s] the guard waits for a beat, and a proof is good.
inline constexpr double beat_timeout = 0.2;

/// The words that a process was started with, where they are in its memory.
struct ProcessWords {
    char* begin = nullptr;  ///< null: they could not be found
    std::size_t size = 0;

    static ProcessWords of_this();
};

/// What the forked guard does, until its engine has ended: never returns. `socket` leads to the engine, the process
/// `engine`, which started with `words`; `lease` is kept open. Allocates nothing: the engine's other threads were not
/// forked.
[[noreturn]] void be_guard(int socket, int lease, pid_t engine, const ProcessWords& words);

}  // namespace nezumi::hw
