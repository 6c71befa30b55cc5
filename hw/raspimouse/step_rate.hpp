// From a wheel's speed to the rate of its stepping motor, as the motor can follow it.
#pragma once

namespace nezumi::hw {

/// One wheel's rate [pulses/s], anew in every tick.
///
/// A new rate waits for the end of the running pulse period, which is 0.2 s at 5 pulses/s: rates below `lowest` are
/// left out while the speed changes, and given only when they are asked for twice in a row. And a stepping motor that
/// is told too much at once loses its steps: where the rate comes from standstill or a stop that was not asked for, it
/// grows no faster than the robot's limits allow.
class StepRate {
public:
    static constexpr int lowest = 20;      ///< [pulses/s], 7.5 mm/s with the mouse's wheels
    static constexpr int at_once = 50;     ///< [pulses/s] that a motor takes from standstill
    static constexpr int highest = 10000;  ///< [pulses/s] of the driver

    /// `metres_per_pulse` of the wheel's rim; `acceleration` [m/s^2] of the rim that the limits allow.
    StepRate(double metres_per_pulse, double acceleration)
        : metres_per_pulse_(metres_per_pulse), acceleration_(acceleration) {}

    /// The rate for `speed` [m/s], when the motor has had `held` [pulses/s] for the last `elapsed` [s].
    int next(double speed, int held, double elapsed);

private:
    double metres_per_pulse_;
    double acceleration_;
    int asked_ = 0;
};

}  // namespace nezumi::hw
