// A sensor of the brick in one of its modes, and the battery, each read on its own thread.
#pragma once

#include <array>
#include <atomic>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "hw/device/node.hpp"
#include "hw/device/sampler.hpp"
#include "hw/ev3/device_class.hpp"

namespace nezumi::hw {

/// How a sensor is read.
struct SensorMode {
    std::string_view driver;  ///< "lego-ev3-gyro"
    std::string_view mode;    ///< "GYRO-G&A"
    std::size_t values = 1;   ///< of `SensorValues::values`
};

struct SensorValues {
    std::array<double, 3> values{};  ///< in the mode's unit, with its decimals
    int plugged_in = 0;              ///< how often the sensor was found: when plugged in again, a gyro starts at 0
};

/// Keeps its sensor in one mode, because a change takes up to 50 ms and the values after it are stale.
class ModeSensor final : public Sampler<SensorValues> {
public:
    /// `folder`: of the class lego-sensor. `port`: such as "in3", or "" for any. `name`: for messages.
    ModeSensor(std::string name, const DevicePath& folder, SensorMode mode, std::string port)
        : Sampler(std::move(name), period), class_(folder), mode_(mode), port_(std::move(port)) {}

    static constexpr double period = 0.02;  ///< [s] between readings
    /// Time [s] after a change of mode in which values are ignored: the change takes up to 50 ms, and then values are
    /// stale for 20 ms.
    static constexpr double settling = 0.08;
    /// Numbers of failed tries, and of tries without effect, to set the mode before an error is reported. The latter
    /// take 0.8 s, because a slow brick needs more time.
    static constexpr int most_failures = 3, most_attempts = 10;

    /// True if the sensor has ever sent a value. Any thread may call it.
    bool was_there() const { return was_there_; }

protected:
    tl::expected<std::optional<SensorValues>, std::string> sample(double now) override;

private:
    struct Nodes {
        explicit Nodes(const DevicePath& folder);
        Node get_mode, set_mode, decimals;
        std::array<Node, 3> values;
    };
    std::string lost(const std::string& why);
    tl::expected<bool, std::string> is_in_mode(double now);

    DeviceClass class_;
    const SensorMode mode_;
    const std::string port_;
    std::optional<Nodes> nodes_;
    double settled_at_ = 0;
    double scale_ = 1;
    int attempts_ = 0;
    int plugged_in_ = 0;
    std::atomic<bool> was_there_ = false;
};

/// The battery's voltage [V]. Counts as failed while it is low.
class Battery final : public Sampler<double> {
public:
    /// `folder` of the class power_supply.
    explicit Battery(const DevicePath& folder);

    /// Low means below its design minimum (`voltage_min_design`, otherwise 6.2 V for six alkaline cells) for
    /// `low_after` [s], until it is `margin` [V] above.
    static constexpr double low_after = 2, margin = 0.2, least = 6.2;

    /// Any thread may call these.
    bool is_low() const { return is_low_; }
    /// The last voltage [V], also a low one; NaN if it can't be read.
    double volts() const;

protected:
    tl::expected<std::optional<double>, std::string> sample(double now) override;

private:
    Node voltage_, design_;
    std::optional<double> low_since_;
    std::atomic<bool> is_low_ = false;
    std::atomic<double> volts_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace nezumi::hw
