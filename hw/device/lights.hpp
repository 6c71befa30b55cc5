// A robot's LEDs, switched on a thread of their own.
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
    /// What a person can do about a node that does not work.
    using Advice = std::string (*)(const NodeError& error);

    /// A node for each LED, which takes the text `on` or "0".
    Lights(const std::vector<DevicePath>& nodes, std::string on, Advice advice);

    /// From the control loop: the newest counts. LEDs that are not named stay as they are.
    void set(const std::vector<bool>& on);
    std::vector<std::string> take_faults();

    double run() override;

private:
    std::vector<Node> nodes_;
    const std::string on_;
    const Advice advice_;
    std::vector<bool> is_on_;  // as written
    Health health_{"LEDs"};
    Mutex mutex_;  // held for a copy at most
    std::vector<bool> wanted_;
};

}  // namespace nezumi::hw
