// Whether the Raspberry Pi gets the voltage that it needs, read on a thread of its own.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "hw/device/node.hpp"
#include "hw/device/sampler.hpp"

namespace nezumi::hw {

/// The kernel's alarm of the Pi's supply (driver raspberrypi-hwmon), which goes on under 4.63 V and off 2 s after that
/// at the earliest. Counts as failed while it is on. A machine without it has nothing to say.
class Supply final : public Sampler<bool> {
public:
    /// `folder` of the class hwmon.
    explicit Supply(DevicePath folder) : Sampler("power supply", period), folder_(std::move(folder)) {}

    static constexpr double period = 0.2;  ///< [s] between readings

    /// From any thread.
    bool is_low() const { return is_low_; }

protected:
    tl::expected<std::optional<bool>, std::string> sample(double now) override;

private:
    void find();

    const DevicePath folder_;
    std::optional<Node> alarm_;
    std::atomic<bool> is_low_ = false;
};

}  // namespace nezumi::hw
