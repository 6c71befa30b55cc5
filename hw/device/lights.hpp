// A robot's LEDs, switched on a separate thread.
#pragma once

#include <string>
#include <vector>

#include "engine/base/mutex.hpp"
#include "hw/device/health.hpp"
#include "hw/device/node.hpp"
#include "hw/device/worker.hpp"

namespace nezumi::hw {

class Lights final : public DeviceJob {
public:
    /// Explains a failed node and what to do.
    using Advice = std::string (*)(const NodeError& error);

    /// `nodes`: one per LED; the text `on` switches it on, "0" off.
    Lights(const std::vector<DevicePath>& nodes, std::string on, Advice advice);

    /// Called by the control loop: sets the wanted states. LEDs beyond the end of `on` are unchanged.
    void set(const std::vector<bool>& on);
    std::vector<std::string> take_faults();

    double run() override;

private:
    std::vector<Node> nodes_;
    const std::string on_;
    const Advice advice_;
    std::vector<bool> is_on_;  // as written
    Health health_{"LEDs"};
    Mutex mutex_;  // held only for a copy
    std::vector<bool> wanted_;
};

}  // namespace nezumi::hw
