// Converts pulses to metres.
#include "hw/device/wheel_values.hpp"

#include <numbers>

namespace nezumi::hw {

Wheels metres_per_pulse(const DriveSpec& drive) {
    const double turn = 2 * std::numbers::pi / drive.encoder_pulses();
    return {.left = turn * drive.radius_of_left(), .right = turn * drive.radius_of_right()};
}

double rim_acceleration(const DriveSpec& drive) {
    const Limits& limits = drive.hardware_limits;
    return limits.acceleration + limits.yaw_acceleration * drive.track / 2;
}

WheelReading wheel_reading(const std::optional<Sample<WheelValues>>& sample, const TickClock& clock, const Time& now,
                           const DriveSpec& drive) {
    if (!sample) return {};
    const Wheels metres = metres_per_pulse(drive);
    const Wheels& rates = sample->value.rates;
    return {.is_there = true,
            .tm = clock.system_time(now, sample->tm),
            .pulses = sample->value.pulses,
            .speeds = {.left = rates.left * metres.left, .right = rates.right * metres.right}};
}

}  // namespace nezumi::hw
