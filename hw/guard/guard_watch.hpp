// The guard as seen by the thread that drives the motors: reports its actions, and allows motion only under its
// protection.
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

    /// True if the motors may turn at `now` [s] (`clock_seconds`): the guard has just proved that it can stop them.
    /// Reports a guard that has ended or does not answer.
    bool may_turn(double now);
    /// True if the motors must be stopped now: the guard has stopped them since the last call, or they turn without
    /// permission. Reports the reason.
    bool must_stop(double now, bool they_turn);
    /// Why the guard could not stop the motors; nothing if it could. After a failure, the nodes must be opened again
    /// and given to `take_up`.
    const std::optional<NodeError>& trouble() const { return guard_->trouble(); }
    /// Calls `Guard::take_up`.
    tl::expected<void, NodeError> take_up(const Node& node, const Guard::Stop& stop) {
        return guard_->take_up(node, stop);
    }
    /// The guard, for threads that give it further nodes.
    const std::shared_ptr<Guard>& guard() const { return guard_; }
    /// Sends a beat, because the control loop has just commanded a motion.
    void beat();
    /// Pauses the beats, because the motors stand.
    void rest() { guard_->rest(); }
    /// Readable when the guard has a message; -1 after it has ended.
    int file() const { return guard_->has_ended() ? -1 : guard_->file(); }
    std::vector<std::string> take_faults() { return health_.take(); }

private:
    std::shared_ptr<Guard> guard_;
    Health health_{"guard of the motors"};
};

}  // namespace nezumi::hw
