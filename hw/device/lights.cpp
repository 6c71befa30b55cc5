// Writes each LED when it changes, and again after a failed write.
#include "hw/device/lights.hpp"

#include <utility>

#include "hw/device/sampler.hpp"

namespace nezumi::hw {

Lights::Lights(const std::vector<DevicePath>& nodes, std::string on, Advice advice)
    : on_(std::move(on)), advice_(advice), is_on_(nodes.size(), false), wanted_(nodes.size(), false) {
    for (const DevicePath& node : nodes) nodes_.emplace_back(node, Node::Access::write);
}

void Lights::set(const std::vector<bool>& on) {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < wanted_.size() && i < on.size(); ++i) wanted_[i] = on[i];
}

std::vector<std::string> Lights::take_faults() {
    if (hangs(clock_seconds())) health_.lost(no_answer);
    return health_.take();
}

double Lights::run() {
    constexpr double idle = 1;  // [s]; new values wake it earlier
    std::vector<bool> wanted;
    {
        const std::lock_guard lock(mutex_);
        wanted = wanted_;
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (is_on_[i] == wanted[i]) continue;
        if (auto ok = nodes_[i].write(wanted[i] ? on_ : "0"); !ok) {
            health_.lost(advice_(ok.error()));
            return retry_period;
        }
        is_on_[i] = wanted[i];
        health_.works();
    }
    return idle;
}

}  // namespace nezumi::hw
