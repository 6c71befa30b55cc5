// The engine's end of a guard process, which stops motors when the engine can't.
#pragma once

#include <sys/types.h>

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "engine/base/error.hpp"
#include "hw/device/files.hpp"
#include "hw/device/node.hpp"
#include "hw/guard/guard_process.hpp"
#include "hw/guard/lease.hpp"

namespace nezumi::hw {

/// Whatever ends the engine, the guard sees it at once and stops the motors; whatever makes it stall, the guard misses
/// its beats. That the guard itself has ended or stalled, or could not stop the motors, the engine sees, which then
/// must stop them. Nothing is promised when both are killed at once. Only `start` and `take_up` of a node without a
/// proof may be called on another thread than the rest.
class Guard {
public:
    /// Takes the lease on the robot that `driver` reaches by `node`, and forks the guard, which stops nothing yet. Call
    /// it on the program's main thread: when the thread that called it has ended, the guard stops the motors. Where
    /// there are no devices behind the node there is no lease. An error when another program holds it, or where the
    /// guard could not outlive this process: as process 1 of a container.
    static Expected<std::unique_ptr<Guard>> start(const std::string& driver, const DevicePath& node);
    /// The guard stops the motors once more and ends.
    ~Guard();
    Guard(const Guard&) = delete;
    Guard& operator=(const Guard&) = delete;

    /// What makes a node stop, and how the guard proves that it could do that.
    struct Stop {
        std::size_t index = 0;  ///< of the node among those of this guard: less than `GuardOrder::most_nodes`
        std::string text;
        Proof proof = Proof::none;
    };
    /// From now on the guard stops this node, which is open, in place of the one with this index: by a descriptor of
    /// its own. What was proved before counts no longer. An error when the node's path is not, or no longer, that of
    /// the file that is open.
    tl::expected<void, NodeError> take_up(const Node& node, const Stop& stop);

    /// The engine is alive at `now` [s by `clock_seconds`] and the motors have power, or shall have it: to be called
    /// more often than `beat_timeout`.
    void beat(double now);
    /// The motors have no power; no beats are needed.
    void rest();
    /// Takes what the guard has said. True when it has stopped the motors since the last call.
    bool has_stopped();
    /// The guard process has ended: nobody would stop the motors.
    bool has_ended() const { return has_ended_; }
    /// It does not answer beats. It may again.
    bool is_late(double now) const { return asked_at_ > 0 && now - asked_at_ > beat_timeout; }
    /// It has proved, of a beat that is no older than `beat_timeout`, that it can stop the motors.
    bool is_proved(double now) const { return !trouble_ && now - proved_at_ <= beat_timeout; }
    /// Why it could not stop them at the last beat.
    const std::optional<NodeError>& trouble() const { return trouble_; }
    /// All guards of this process stop their motors, and let nothing turn any more. Waits until they have been told,
    /// `longest_braking` at most. From any thread, whatever the others do: for a program that is about to end at once.
    static void brake_all();
    static constexpr std::chrono::milliseconds longest_braking{300};
    /// Has something to read, or is at its end, when the guard has.
    int file() const { return socket_; }
    pid_t process() const { return process_; }

private:
    Guard(Lease lease, int socket, pid_t process);
    void say(GuardOrder::Kind kind, double now = 0);

    // Beats that follow each other faster [s] say nothing new.
    static constexpr double shortest_beat = 0.01;

    Lease lease_;
    int socket_;
    pid_t process_;
    std::array<std::string, GuardOrder::most_nodes> paths_;
    bool has_ended_ = false;
    bool beats_ = false;
    double beat_at_ = 0;      // [s] the last one
    double asked_at_ = 0;     // [s] the first one that has no answer yet; 0: none
    double taken_up_at_ = 0;  // [s] since when the guard has these nodes
    double proved_at_ = -1;   // [s] the last beat that was answered by a proof; below 0: none
    std::optional<NodeError> trouble_;
};

}  // namespace nezumi::hw
