// Checks on its own thread whether the supply voltage of the Raspberry Pi is high enough.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "hw/device/node.hpp"
#include "hw/device/sampler.hpp"

namespace nezumi::hw {

/// Reads the kernel's alarm for the Pi's supply (driver raspberrypi-hwmon): on below 4.63 V, off at least 2 s later.
/// The supply counts as failed while the alarm is on. A machine without this driver reports nothing.
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
