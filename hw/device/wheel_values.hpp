// Readings of wheel encoders and their rates.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "engine/world/world.hpp"
#include "hw/device/sampler.hpp"
#include "hw/device/tick_clock.hpp"

namespace nezumi::hw {

/// The positions and speeds of the wheels.
struct WheelValues {
    WheelPulses pulses;  ///< since the start
    Wheels rates;        ///< [pulses/s]
};

/// Travel [m] of each wheel's rim per pulse.
Wheels metres_per_pulse(const DriveSpec& drive);
/// Acceleration [m/s^2] of one rim when forward and yaw acceleration are both at their hardware limits.
double rim_acceleration(const DriveSpec& drive);
/// The wheel reading of a body at `now`, from the newest sample.
WheelReading wheel_reading(const std::optional<Sample<WheelValues>>& sample, const TickClock& clock, const Time& now,
                           const DriveSpec& drive);

/// Measures the rate of a counter from the times of its readings.
class PulseRate {
public:
    static constexpr double window = 0.05;  ///< [s] time over which the rate is measured

    /// Adds a reading at `tm` [s].
    void take(double tm, std::int64_t pulses) {
        readings_.push_back({tm, pulses});
        while (readings_.size() > 2 && tm - readings_[1].tm >= window) readings_.pop_front();
    }
    /// [pulses/s]; 0 before the second reading.
    double rate() const {
        if (readings_.empty()) return 0;
        const double passed = readings_.back().tm - readings_.front().tm;
        return passed > 0 ? static_cast<double>(readings_.back().pulses - readings_.front().pulses) / passed : 0;
    }

private:
    struct Reading {
        double tm;
        std::int64_t pulses;
    };
    std::deque<Reading> readings_;  // back to the length of the window
};

}  // namespace nezumi::hw
