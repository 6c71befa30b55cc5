// A sensor as ev3dev's class lego-sensor has it: modes, whose change takes its time and leaves stale values.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nezumi::fakes {

/// What there is to be sensed.
struct Ev3Surroundings {
    double distance = 2.5;          ///< [m]
    double angle = 0, rate = 0;     ///< [rad], [rad/s] counter-clockwise
    std::array<int, 3> floor{};     ///< red, green, blue of RGB-RAW
    std::array<bool, 2> touched{};  ///< right, left
};

class Ev3Sensor {
public:
    /// "lego-ev3-gyro"; `channel` of a touch sensor: 0 right, 1 left.
    explicit Ev3Sensor(std::string driver, std::size_t channel = 0);

    /// [s] for which values are the old mode's after a change.
    static constexpr double stale = 0.02;

    const std::string& driver() const { return driver_; }
    /// 0 or -EINVAL: there is no such mode.
    int set_mode(std::string_view mode, double now);
    void plug_in(const Ev3Surroundings& around);
    /// Nothing when there is no such attribute.
    std::optional<std::string> read(const std::string& attribute, const Ev3Surroundings& around, double now) const;

private:
    std::vector<int> values(const std::string& mode, const Ev3Surroundings& around) const;

    std::string driver_;
    std::size_t channel_;
    std::vector<std::string> modes_;
    std::string mode_, before_;
    double changed_at_ = -1;
    double zero_ = 0;  // gyro: its angle when it was plugged in [rad]
};

}  // namespace nezumi::fakes
