// The mouse's light sensors, switches and wheel counters, each read on its own thread.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "hw/device/node.hpp"
#include "hw/device/sampler.hpp"
#include "hw/device/wheel_values.hpp"
#include "hw/raspimouse/codec.hpp"
#include "hw/raspimouse/motors.hpp"
#include "hw/raspimouse/pulse_counter.hpp"

namespace nezumi::hw {

class LightSensors final : public Sampler<LightValues> {
public:
    explicit LightSensors(const DevicePath& folder);

    /// This number of readings `0 0 0 0` in a row means that the sensors do not measure: noise would give other values.
    static constexpr int zeros_to_doubt = 100;

protected:
    tl::expected<std::optional<LightValues>, std::string> sample(double now) override;

private:
    Node node_;
    int zeros_ = 0;
};

/// True for each pressed switch.
using SwitchValues = std::array<bool, 3>;

class Switches final : public Sampler<SwitchValues> {
public:
    explicit Switches(const DevicePath& folder);

protected:
    tl::expected<std::optional<SwitchValues>, std::string> sample(double now) override;

private:
    std::array<Node, 3> nodes_;
};

class WheelCounters final : public Sampler<WheelValues> {
public:
    WheelCounters(const DevicePath& folder, std::shared_ptr<CommandedWheels> commanded);

protected:
    tl::expected<std::optional<WheelValues>, std::string> sample(double now) override;

private:
    struct Wheel {
        explicit Wheel(DevicePath path) : node(std::move(path), Node::Access::read) {}
        Node node;
        PulseCounter counter;
        PulseRate rate;
    };
    tl::expected<PulseCounter::Verdict, std::string> read(Wheel& wheel, const CommandedPulses& commanded);

    std::shared_ptr<CommandedWheels> commanded_;
    Wheel left_, right_;
    int zeros_ = 0;
    bool was_there_ = false;
};

}  // namespace nezumi::hw
