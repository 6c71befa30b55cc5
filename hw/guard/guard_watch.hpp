// A guard as the thread that drives the motors sees it: what it has done is told, and without it nothing turns.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hw/device/health.hpp"
#include "hw/guard/guard.hpp"

namespace nezumi::hw {

class GuardWatch {
public:
    explicit GuardWatch(std::shared_ptr<Guard> guard) : guard_(std::move(guard)) {}

    /// Whether the motors may turn at `now` [s] by `clock_seconds`: the guard has just proved that it can stop them.
    /// Told where it has ended or does not answer.
    bool may_turn(double now);
    /// Whether motors must be stopped: the guard has stopped them since the last call, or they turn and may not. Told.
    bool must_stop(double now, bool they_turn);
    /// Why it could not stop them: their nodes are to be opened anew, and given to `take_up`.
    const std::optional<NodeError>& trouble() const { return guard_->trouble(); }
    /// As `Guard::take_up`.
    tl::expected<void, NodeError> take_up(const Node& node, const Guard::Stop& stop) {
        return guard_->take_up(node, stop);
    }
    /// For those that give it nodes on other threads.
    const std::shared_ptr<Guard>& guard() const { return guard_; }
    /// The motors turn, or are to, because the control loop has wanted it just now.
    void beat();
    /// The motors stand; no beats are needed.
    void rest() { guard_->rest(); }
    /// Has something to read when it has something to say; -1: never again.
    int file() const { return guard_->has_ended() ? -1 : guard_->file(); }
    std::vector<std::string> take_faults() { return health_.take(); }

private:
    std::shared_ptr<Guard> guard_;
    Health health_{"guard of the motors"};
};

}  // namespace nezumi::hw
