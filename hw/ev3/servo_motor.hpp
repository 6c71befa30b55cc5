// The EV3's medium motor as a servo, on its own thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/mutex.hpp"
#include "hw/device/health.hpp"
#include "hw/device/worker.hpp"
#include "hw/ev3/tacho_motor.hpp"
#include "hw/guard/guard.hpp"

namespace nezumi::hw {

/// The job of moving a servo. Angle 0 is the position where the motor was first found. If the motor is missing, this is
/// reported, and it works as soon as it is plugged in.
class ServoMotor final : public DeviceJob {
public:
    /// `folder` of the class tacho-motor. `name` is for messages: "medium motor 'arm'". `guard` stops this motor too.
    ServoMotor(const DevicePath& folder, const std::string& port, std::string name, std::shared_ptr<Guard> guard)
        : motor_(folder, "lego-ev3-m-motor", port), guard_(std::move(guard)), health_(std::move(name)) {}

    /// Called by the control loop: turns to `angle` [rad] at `speed` [rad/s] (0: the fastest).
    void aim(double angle, double speed);
    /// The angle [rad] as last read.
    double angle() const;
    std::vector<std::string> take_faults();

    double run() override;
    void end() override;

private:
    struct Target {
        double angle = 0;
        double speed = 0;
    };
    tl::expected<void, std::string> serve();
    double radians_per_pulse() const;

    TachoMotor motor_;
    std::shared_ptr<Guard> guard_;
    Health health_;
    mutable Mutex mutex_;  // held only for a copy
    std::optional<Target> target_;
    bool is_new_ = false;
    double angle_ = 0;
};

}  // namespace nezumi::hw
