// A guard as the thread that drives the motors sees it: what it has done is told, and without it nothing turns.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hw/device/health.hpp"
#include "hw/guard/guard.hpp"

namespace nezumi::hw {

class GuardWatch {
public:
    explicit GuardWatch(std::unique_ptr<Guard> guard) : guard_(std::move(guard)) {}

    /// Whether it has stopped the motors since the last call; told.
    bool has_stopped();
    /// Whether there is a guard that answers, at `now` [s] by `clock_seconds`: without it the motors must not turn.
    /// Told.
    bool is_awake(double now);
    /// The motors turn, or may, because the control loop has wanted it just now.
    void beat();
    /// The motors stand; no beats are needed.
    void rest() { guard_->rest(); }
    /// Has something to read when it has something to say; -1: never again.
    int file() const { return guard_->has_ended() ? -1 : guard_->file(); }
    std::vector<std::string> take_faults() { return health_.take(); }

private:
    std::unique_ptr<Guard> guard_;
    Health health_{"guard of the motors"};
};

}  // namespace nezumi::hw
