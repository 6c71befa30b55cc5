// A real Raspberry Pi Mouse as a robot's body.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/system/build_system.hpp"
#include "engine/world/world.hpp"
#include "hw/device/lights.hpp"
#include "hw/device/roots.hpp"
#include "hw/device/tick_clock.hpp"
#include "hw/device/worker.hpp"
#include "hw/raspimouse/motors.hpp"
#include "hw/raspimouse/sensors.hpp"
#include "hw/raspimouse/supply.hpp"
#include "hw/sound/speaker.hpp"

namespace nezumi::hw {

/// Functions never block on a device, because each device has its own thread.
class MouseBody final : public RobotBody {
public:
    /// A range sensor of the spec is the light sensor of its `port`, "0" (right front) to "3"; a button is the switch
    /// of its `port`, "rtswitch0" to "rtswitch2". Sensors without a port get the remaining ones in the order of their
    /// names. Fails, with what to do, if there are too many, if a `port` is unknown, if motors or their power are
    /// missing, or if another program drives them. Other missing devices are reported as faults. `spec` must outlive
    /// the body.
    static Expected<std::unique_ptr<RobotBody>> make(const RobotSpec& spec, const DeviceRoots& roots);

    RobotId id() const override { return not_simulated; }
    WheelReading read_wheels(const Time& now, double period) override;
    std::span<const SensorReading> read_sensors(const Time& now, double period) override;
    std::vector<std::string> take_faults() override;
    bool may_drive() const override { return !supply_->is_low(); }
    void set_wheel_speeds(Wheels speeds) override;
    void coast() override;
    void set_motor_power(bool on) override;
    void aim_servo(std::size_t /*index*/, double /*angle*/, double /*speed*/) override {}
    void set_leds(const std::vector<bool>& on) override;
    void play(const Sound& sound) override { loudspeaker_.play(sound); }
    void silence() override { loudspeaker_.silence(); }
    void set_buzzer(int hertz) override;

private:
    // The index of a sensor in the spec, and the index of its device.
    struct Wired {
        std::size_t sensor, channel;
        int converted = 0;  // the raw value that the present reading was computed from
    };
    static Expected<std::vector<Wired>> wire(const RobotSpec& spec, SensorSpec::Kind kind, std::string_view port_begin,
                                             std::size_t devices);
    MouseBody(const RobotSpec& spec, const DeviceRoots& roots, std::unique_ptr<Motors> motors,
              std::vector<Wired> ranges, std::vector<Wired> buttons);
    void send();

    const RobotSpec& spec_;
    std::vector<Wired> ranges_, buttons_;
    std::vector<SensorReading> readings_;
    TickClock clock_;
    MotorCommand command_;
    bool may_have_power_ = false;

    Loudspeaker loudspeaker_;
    RunningJob<Motors> motors_;
    RunningJob<WheelCounters> counters_;
    RunningJob<LightSensors> light_sensors_;
    RunningJob<Switches> switches_;
    RunningJob<Lights> lights_;
    RunningJob<Supply> supply_;
};

}  // namespace nezumi::hw
