// Converts a wheel's speed to a rate that its stepping motor can follow.
#pragma once

namespace nezumi::hw {

/// One wheel's rate [pulses/s], computed in every tick.
///
/// A new rate takes effect after the present pulse period, which is 0.2 s at 5 pulses/s. So rates below `lowest` are
/// skipped while the speed changes, and used only when requested twice in a row. A stepping motor loses steps if the
/// rate jumps: from standstill, or after an unexpected stop, the rate grows within the robot's limits.
class StepRate {
public:
    static constexpr int lowest = 20;      ///< [pulses/s], 7.5 mm/s with the mouse's wheels
    static constexpr int at_once = 50;     ///< [pulses/s] possible from standstill
    static constexpr int highest = 10000;  ///< [pulses/s] limit of the kernel's driver

    /// `metres_per_pulse` of the wheel's rim; `acceleration` [m/s^2] is the limit of the rim.
    StepRate(double metres_per_pulse, double acceleration)
        : metres_per_pulse_(metres_per_pulse), acceleration_(acceleration) {}

    /// The next rate for `speed` [m/s], if the motor had the rate `held` [pulses/s] for the last `elapsed` [s].
    int next(double speed, int held, double elapsed);

private:
    double metres_per_pulse_;
    double acceleration_;
    int asked_ = 0;
};

}  // namespace nezumi::hw
