// Each LED is written when it changes, and again when a write failed.
#include "hw/raspimouse/lights.hpp"

#include "hw/device/sampler.hpp"
#include "hw/raspimouse/advice.hpp"
#include "hw/raspimouse/codec.hpp"

namespace nezumi::hw {

Lights::Lights(const std::string& folder) : is_on_(count, false), wanted_(count, false) {
    for (std::size_t i = 0; i < count; ++i)
        nodes_.emplace_back(folder + "/rtled" + std::to_string(i), Node::Access::write);
}

void Lights::set(const std::vector<bool>& on) {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < count && i < on.size(); ++i) wanted_[i] = on[i];
}

std::vector<std::string> Lights::take_faults() {
    if (hangs(clock_seconds())) health_.lost(no_answer);
    return health_.take();
}

double Lights::run() {
    constexpr double idle = 1;  // [s]; it is woken when something is to be done
    std::vector<bool> wanted;
    {
        const std::lock_guard lock(mutex_);
        wanted = wanted_;
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (is_on_[i] == wanted[i]) continue;
        if (auto ok = nodes_[i].write(encode_switch(wanted[i])); !ok) {
            health_.lost(with_advice(ok.error()));
            return retry_period;
        }
        is_on_[i] = wanted[i];
        health_.works();
    }
    return idle;
}

}  // namespace nezumi::hw
