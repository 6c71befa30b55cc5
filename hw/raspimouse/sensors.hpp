// The mouse's light sensors, switches and wheel counters, each read on a thread of its own.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "engine/world/world.hpp"
#include "hw/device/node.hpp"
#include "hw/device/sampler.hpp"
#include "hw/raspimouse/codec.hpp"
#include "hw/raspimouse/motors.hpp"
#include "hw/raspimouse/pulse_counter.hpp"

namespace nezumi::hw {

class LightSensors final : public Sampler<LightValues> {
public:
    explicit LightSensors(const std::string& folder);

    /// So many times `0 0 0 0` in a row is no measurement: noise alone would be more.
    static constexpr int zeros_to_doubt = 100;

protected:
    tl::expected<std::optional<LightValues>, std::string> sample(double now) override;

private:
    Node node_;
    int zeros_ = 0;
};

/// Whether each is pressed.
using SwitchValues = std::array<bool, 3>;

class Switches final : public Sampler<SwitchValues> {
public:
    explicit Switches(const std::string& folder);

protected:
    tl::expected<std::optional<SwitchValues>, std::string> sample(double now) override;

private:
    std::array<Node, 3> nodes_;
};

/// How far the wheels have turned, and how fast they do.
struct WheelValues {
    WheelPulses pulses;  ///< since the start
    Wheels rates;        ///< [pulses/s]
};

class WheelCounters final : public Sampler<WheelValues> {
public:
    WheelCounters(const std::string& folder, std::shared_ptr<CommandedWheels> commanded);

    /// [s] over which a rate is measured: at 0.2 m/s that is 26 pulses.
    static constexpr double rate_window = 0.05;

protected:
    tl::expected<std::optional<WheelValues>, std::string> sample(double now) override;

private:
    struct Counted {
        double tm;
        std::int64_t pulses;
    };
    struct Wheel {
        explicit Wheel(std::string path) : node(std::move(path), Node::Access::read) {}
        double rate() const;

        Node node;
        PulseCounter counter;
        std::deque<Counted> counted;  // as far back as the window
    };
    tl::expected<PulseCounter::Verdict, std::string> read(Wheel& wheel, const CommandedPulses& commanded);

    std::shared_ptr<CommandedWheels> commanded_;
    Wheel left_, right_;
    int zeros_ = 0;
    bool was_there_ = false;
};

}  // namespace nezumi::hw
