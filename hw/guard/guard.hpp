// Starts and controls the guard: the process that stops motors when the engine can't.
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

/// If the engine ends for any reason, the guard notices immediately and stops the motors. If the engine stalls, its
/// beats are missing, and the guard stops the motors. If the guard ends, stalls or can't stop the motors, the engine
/// notices and must stop them. Nothing is guaranteed if both are killed at the same time. Call all functions on one
/// thread; only `start`, and `take_up` of a node without proof, may be called on another thread.
class Guard {
public:
    /// Takes the lease on the robot that `driver` reaches by `node` and forks the guard, without nodes at first. Call
    /// it on the program's main thread: when the calling thread ends, the guard stops the motors. Without real devices,
    /// no lease is taken. Fails if another program holds the lease, or if the guard could not outlive this process,
    /// because this is process 1 of a container.
    static Expected<std::unique_ptr<Guard>> start(const std::string& driver, const DevicePath& node);
    /// Lets the guard stop the motors once more and end.
    ~Guard();
    Guard(const Guard&) = delete;
    Guard& operator=(const Guard&) = delete;

    /// The text that stops a node, and how the guard proves that it could write it.
    struct Stop {
        std::size_t index = 0;  ///< of the node in this guard: below `GuardOrder::most_nodes`
        std::string text;
        Proof proof = Proof::none;
    };
    /// Gives the guard an open node to stop, which replaces the node with the same index. The guard gets a new
    /// descriptor. Earlier proofs become invalid. Fails if the node's path does not lead to the open file now.
    tl::expected<void, NodeError> take_up(const Node& node, const Stop& stop);

    /// Reports that the engine is alive at `now` [s by `clock_seconds`] and the motors have power or will have it. Must
    /// be called more often than `beat_timeout`.
    void beat(double now);
    /// The motors have no power, so no beats are needed.
    void rest();
    /// Receives the guard's messages. Returns true if it has stopped the motors since the last call.
    bool has_stopped();
    /// True if the guard process has ended, so that it can't stop the motors.
    bool has_ended() const { return has_ended_; }
    /// True if the guard does not answer beats in time. It may recover.
    bool is_late(double now) const { return asked_at_ > 0 && now - asked_at_ > beat_timeout; }
    /// True if the guard has proved, for a beat no older than `beat_timeout`, that it can stop the motors.
    bool is_proved(double now) const { return !trouble_ && now - proved_at_ <= beat_timeout; }
    /// Why the guard could not stop the motors at the last beat; nothing if it could.
    const std::optional<NodeError>& trouble() const { return trouble_; }
    /// Orders all guards of this process to stop their motors and to prevent any further motion. For a program that is
    /// about to end at once. Waits until the orders are received, for at most `longest_braking`. Any thread may call it
    /// at any time.
    static void brake_all();
    static constexpr std::chrono::milliseconds longest_braking{300};
    /// Readable when the guard has sent a message or ended.
    int file() const { return socket_; }
    pid_t process() const { return process_; }

private:
    Guard(Lease lease, int socket, pid_t process);
    void say(GuardOrder::Kind kind, double now = 0);

    // Beats at shorter intervals [s] are not sent.
    static constexpr double shortest_beat = 0.01;

    Lease lease_;
    int socket_;
    pid_t process_;
    std::array<std::string, GuardOrder::most_nodes> paths_;
    bool has_ended_ = false;
    bool beats_ = false;
    double beat_at_ = 0;      // [s] time of the last one
    double asked_at_ = 0;     // [s] time of the first one without an answer; 0: none
    double taken_up_at_ = 0;  // [s] time when the guard got these nodes
    double proved_at_ = -1;   // [s] time of the last beat with a proof; below 0: none
    std::optional<NodeError> trouble_;
};

}  // namespace nezumi::hw
