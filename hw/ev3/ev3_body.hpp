// A real LEGO EV3 with ev3dev as a robot's body.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/system/build_system.hpp"
#include "engine/world/world.hpp"
#include "hw/device/lights.hpp"
#include "hw/device/roots.hpp"
#include "hw/device/tick_clock.hpp"
#include "hw/device/worker.hpp"
#include "hw/ev3/brick_keys.hpp"
#include "hw/ev3/screen.hpp"
#include "hw/ev3/sensors.hpp"
#include "hw/ev3/servo_motor.hpp"
#include "hw/ev3/wheel_motors.hpp"
#include "hw/sound/speaker.hpp"

namespace nezumi::hw {

/// Converts a gyro's value to its angle, counter-clockwise [rad]. The value is in whole degrees clockwise, modulo
/// 65536, and is 0 when the gyro is plugged in.
class GyroAngle {
public:
    double take(const SensorValues& values);

private:
    std::optional<int> last_;
    int plugged_in_ = 0;
    double degrees_ = 0;
};

/// Converts values of the mode RGB-RAW, in which white paper gives 300 per channel, to a colour. Returns nothing if no
/// surface is in range.
std::optional<Rgb> floor_seen(const SensorValues& values);

/// Functions never block on a device, because each device has its own thread.
class Ev3Body final : public RobotBody {
public:
    /// Finds a device by its kind, and by its `port` if the spec has one ("in3", "outB"). The default ports are outB
    /// and outC for the wheels' motors and outA for a servo. If there are several sensors of a kind, each needs a port.
    /// A button is one of `brick_keys`. Fails, with what to do, if there are more devices than the brick can have, if a
    /// wheel's motor is missing, or if another program drives it. Other missing devices are reported as faults. `spec`
    /// must outlive the body.
    static Expected<std::unique_ptr<RobotBody>> make(const RobotSpec& spec, const DeviceRoots& roots);

    RobotId id() const override { return not_simulated; }
    WheelReading read_wheels(const Time& now, double period) override;
    std::span<const SensorReading> read_sensors(const Time& now, double period) override;
    double servo_angle(std::size_t index) const override;
    std::vector<std::string> take_faults() override;
    bool may_drive() const override { return !battery_->is_low(); }
    std::optional<double> battery() const override { return battery_->volts(); }
    bool is_stalled() const override { return wheels_->is_stalled(); }
    void set_wheel_speeds(Wheels speeds) override;
    void coast() override;
    void set_motor_power(bool on) override;
    void aim_servo(std::size_t index, double angle, double speed) override;
    void set_leds(const std::vector<bool>& on) override;
    void play(const Sound& sound) override { loudspeaker_.play(sound); }
    void silence() override { loudspeaker_.silence(); }
    void show(std::size_t index, const CameraImage& picture) override;

private:
    Ev3Body(const RobotSpec& spec, const DeviceRoots& roots, std::unique_ptr<WheelMotors> wheels,
            std::unique_ptr<ServoMotor> servo, std::size_t servo_index);
    void add_sensors(const DevicePath& folder);
    void read(std::size_t sensor, const SensorValues& values);
    bool is_touch_elsewhere(std::size_t sensor) const;
    void read_keys(const Time& now, double clock);

    const RobotSpec& spec_;
    std::vector<SensorReading> readings_;
    std::vector<const RunningJob<ModeSensor>*> channel_of_;  // a sensor's device; null: none
    std::vector<std::pair<std::size_t, std::size_t>>
        keys_of_;  // sensors that are keys: indices in the spec and in `brick_keys`
    TickClock clock_;
    bool may_have_power_ = false;
    std::size_t servo_index_;
    GyroAngle gyro_;

    Loudspeaker loudspeaker_;
    RunningJob<WheelMotors> wheels_;
    RunningJob<Lights> lights_;
    RunningJob<BrickScreen> screen_;
    RunningJob<Battery> battery_;
    std::optional<RunningJob<ServoMotor>> servo_;
    std::optional<RunningJob<BrickKeys>> keys_;
    std::vector<std::unique_ptr<RunningJob<ModeSensor>>> channels_;  // colour and reflected light share one
};

}  // namespace nezumi::hw
