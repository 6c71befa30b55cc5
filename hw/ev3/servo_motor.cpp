// The target is written once: the kernel turns the motor there and holds it.
#include "hw/ev3/servo_motor.hpp"

#include <cmath>
#include <numbers>

#include "hw/device/clock.hpp"
#include "hw/device/sampler.hpp"
#include "hw/ev3/wheel_motors.hpp"

namespace nezumi::hw {

double ServoMotor::radians_per_pulse() const { return 2 * std::numbers::pi / motor_.pulses_per_turn(); }

void ServoMotor::aim(double angle, double speed) {
    const std::lock_guard lock(mutex_);
    target_ = {angle, speed};
    is_new_ = true;
}

double ServoMotor::angle() const {
    const std::lock_guard lock(mutex_);
    return angle_;
}

std::vector<std::string> ServoMotor::take_faults() {
    if (hangs(clock_seconds())) health_.lost(no_answer);
    return health_.take();
}

tl::expected<void, std::string> ServoMotor::serve() {
    if (!motor_.is_found()) {
        if (auto ok = motor_.find(); !ok) return ok;
        // Needs no proof, because the motor stops at its target on its own. So the wheels need not wait for a proof.
        const auto guarded = guard_->take_up(motor_.command_node(), {.index = WheelMotors::count, .text = "stop"});
        if (!guarded) return tl::unexpected(motor_.give_up(with_ev3_advice(guarded.error())));
    }
    if (health_.is_lost()) {
        if (auto ok = motor_.prepare(); !ok) return ok;
        const std::lock_guard lock(mutex_);
        is_new_ = target_.has_value();
    }
    const auto position = motor_.position();
    if (!position) return tl::unexpected(position.error());
    std::optional<Target> target;
    {
        const std::lock_guard lock(mutex_);
        angle_ = static_cast<double>(*position) * radians_per_pulse();
        if (std::exchange(is_new_, false)) target = target_;
    }
    if (!target) return {};
    const double per_pulse = radians_per_pulse();
    return motor_.go_to(std::llround(target->angle / per_pulse),
                        static_cast<int>(std::ceil(target->speed / per_pulse)));
}

double ServoMotor::run() {
    constexpr double period = 0.02;  // [s]
    if (auto ok = serve(); !ok) {
        health_.lost(ok.error());
        return retry_period;
    }
    health_.works();
    return period;
}

void ServoMotor::end() {
    if (motor_.is_found()) static_cast<void>(motor_.coast());
}

}  // namespace nezumi::hw
