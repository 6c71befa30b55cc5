// The EV3's medium motor, which turns to an angle, on a thread of its own.
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

/// A job. Its angle is 0 where it stood when it was found first. It may be missing: it is told, and taken up when it is
/// there.
class ServoMotor final : public DeviceJob {
public:
    /// `folder` of the class tacho-motor; `name` as a person calls it: "medium motor 'arm'". `guard` stops it as well.
    ServoMotor(const DevicePath& folder, const std::string& port, std::string name, std::shared_ptr<Guard> guard)
        : motor_(folder, "lego-ev3-m-motor", port), guard_(std::move(guard)), health_(std::move(name)) {}

    /// From the control loop: turns to `angle` [rad] at `speed` [rad/s] (0: as fast as it can).
    void aim(double angle, double speed);
    /// [rad] as it was read last.
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
    mutable Mutex mutex_;  // held for a copy at most
    std::optional<Target> target_;
    bool is_new_ = false;
    double angle_ = 0;
};

}  // namespace nezumi::hw
