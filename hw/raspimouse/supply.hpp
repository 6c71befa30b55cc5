// Whether the Raspberry Pi has enough voltage, read on its own thread.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "hw/device/node.hpp"
#include "hw/device/sampler.hpp"

namespace nezumi::hw {

/// The kernel's alarm for the Pi's supply (driver raspberrypi-hwmon): on below 4.63 V, off at least 2 s later. Counts
/// as failed while it is on. A machine without this driver reports nothing.
class Supply final : public Sampler<bool> {
public:
    /// `folder` of the class hwmon.
    explicit Supply(DevicePath folder) : Sampler("power supply", period), folder_(std::move(folder)) {}

    static constexpr double period = 0.2;  ///< [s] between readings

    /// Any thread may call it.
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
