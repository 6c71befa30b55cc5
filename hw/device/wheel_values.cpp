// From pulses to metres.
#include "hw/device/wheel_values.hpp"

#include <numbers>

namespace nezumi::hw {

double metres_per_pulse(const DriveSpec& drive) { return 2 * std::numbers::pi * drive.radius / drive.encoder_pulses(); }

double rim_acceleration(const DriveSpec& drive) {
    const Limits& limits = drive.hardware_limits;
    return limits.acceleration + limits.yaw_acceleration * drive.track / 2;
}

WheelReading wheel_reading(const std::optional<Sample<WheelValues>>& sample, const TickClock& clock, const Time& now,
                           const DriveSpec& drive) {
    if (!sample) return {};
    const double metres = metres_per_pulse(drive);
    const Wheels& rates = sample->value.rates;
    return {.is_there = true,
            .tm = clock.system_time(now, sample->tm),
            .pulses = sample->value.pulses,
            .speeds = {.left = rates.left * metres, .right = rates.right * metres}};
}

}  // namespace nezumi::hw
