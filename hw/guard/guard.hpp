// The engine's end of a guard process, which stops motors when the engine can't.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "hw/device/files.hpp"
#include "hw/guard/guard_process.hpp"
#include "hw/guard/lease.hpp"

namespace nezumi::hw {

/// Whatever ends the engine, the guard sees it at once and stops the motors; whatever makes it stall, the guard misses
/// its beats. That the guard itself has ended or stalled the engine sees, which then must stop the motors. Nothing is
/// promised when both are killed at once. Only `start` may be called on another thread than the rest.
class Guard {
public:
    /// Takes the lease on the node `lease` and forks the guard. `stop_writes` are done in this order. Call it on the
    /// program's main thread: when the thread that called it has ended, the guard stops the motors. Where there are no
    /// devices behind the node it stops nothing. An error when another program holds the lease.
    static Expected<std::unique_ptr<Guard>> start(const DevicePath& lease, std::vector<StopWrite> stop_writes);
    /// The guard stops the motors once more and ends.
    ~Guard();
    Guard(const Guard&) = delete;
    Guard& operator=(const Guard&) = delete;

    /// The engine is alive at `now` [s] and the motors have power: to be called more often than `beat_timeout`.
    void beat(double now);
    /// The motors have no power; no beats are needed.
    void rest();
    /// Takes what the guard has said. True when it has stopped the motors since the last call.
    bool has_stopped();
    /// The guard process has ended: nobody would stop the motors.
    bool has_ended() const { return has_ended_; }
    /// It does not answer beats. It may again.
    bool is_late(double now) const { return asked_at_ > 0 && now - asked_at_ > beat_timeout; }
    /// All guards of this process stop their motors now. Waits until they have said so, `longest_braking` at most. From
    /// any thread, whatever the others are in the middle of: for a program that is about to end.
    static void brake_all();
    static constexpr std::chrono::milliseconds longest_braking{300};
    /// Has something to read, or is at its end, when the guard has.
    int file() const { return socket_; }
    pid_t process() const { return process_; }

private:
    Guard(Lease lease, int socket, pid_t process);
    void say(GuardMessage message);

    // Beats that follow each other faster [s] say nothing new.
    static constexpr double shortest_beat = 0.01;

    Lease lease_;
    int socket_;
    pid_t process_;
    std::atomic<bool> has_ended_ = false;
    std::atomic<int> stops_ = 0;  // that it has told of
    bool beats_ = false;
    double beat_at_ = 0;   // [s] the last one
    double asked_at_ = 0;  // [s] the first one that has no answer yet; 0: none
};

}  // namespace nezumi::hw
