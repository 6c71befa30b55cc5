// A robot's body whose driver is a behaviour: commands and readings go through ports of the robot.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/components/component.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

/// The ports have the names of the robot's ports or sensors with a prefix. `driver_`: for the driver, which reads what
/// is commanded (after limits, acceleration and braking) and writes what is measured. `model_`: in simulation, for the
/// behaviour that stands for the robot's devices; it gets what the simulated sensors measure, and drives the simulated
/// wheels.
///
/// The driver writes the ports of sensors; and of the wheels, either `wheel_pulses` or the velocity.
class ScriptedBody final : public RobotBody {
public:
    static constexpr std::string_view to_driver = "driver_", to_model = "model_";
    static constexpr std::string_view wheel_pulses = "wheel_pulses", may_drive_port = "may_drive";

    /// Where a robot gets its ports.
    struct Ports {
        std::vector<std::unique_ptr<InPortBase>>& in;
        std::vector<std::unique_ptr<OutPortBase>>& out;
    };
    /// Adds the ports. `simulated`: the body in the world; null: the robot is real. `spec` must outlive it.
    ScriptedBody(const RobotSpec& spec, Ports ports, std::unique_ptr<RobotBody> simulated);

    /// From now on the robot drives only while `works` returns true. `works` uses the component `part`, so `forget`
    /// must be called before `part` is destroyed.
    void need(const Component& part, std::function<bool()> works) { needed_.push_back({&part, std::move(works)}); }
    /// Must be called before the component `gone` is destroyed. If it is needed to drive, the robot drives no more.
    void forget(const Component& gone);
    /// Whether this component is needed to drive.
    bool needs(const Component& part) const;

    RobotId id() const override { return simulated_ != nullptr ? simulated_->id() : not_simulated; }
    WheelReading read_wheels(const Time& now, double period) override;
    std::span<const SensorReading> read_sensors(const Time& now, double period) override;
    std::span<const double> sensor_values(std::size_t index) const override { return values_[index]; }
    std::span<const Neighbour> neighbours(std::size_t index) const override {
        return simulated_ != nullptr ? simulated_->neighbours(index) : std::span<const Neighbour>();
    }
    void say(std::span<const double> message) override {
        if (simulated_ != nullptr) simulated_->say(message);
    }
    double servo_angle(std::size_t index) const override;
    std::vector<std::string> take_faults() override;
    bool may_drive() const override;

    void set_wheel_speeds(Wheels speeds) override;
    void coast() override { set_wheel_speeds({}); }
    void aim_servo(std::size_t index, double angle, double speed) override;
    void set_leds(const std::vector<bool>& on) override;
    void set_buzzer(int hertz) override;
    void show(std::size_t index, const CameraImage& picture) override;

private:
    // An in-port for a sensor port of the robot.
    struct Sensed {
        InPortBase* port;
        std::vector<std::size_t> sensors;
        bool physical;             // as in `SensorReading`
        std::size_t first, count;  // of a sensor with several values; 0: each sensor has one
    };
    struct Needed {
        const Component* part;
        std::function<bool()> works;
    };
    void add_sensor_port(const PortSpec& port, Ports ports);
    void add_model_ports(Ports ports);
    void take_pulses(const Time& now);
    void take_velocity(const Time& now, double period);
    void take(const Sensed& sensed);
    void show_model(const Time& now, double period);
    OutPortBase* actuator_port(ActuatorSpec::Kind kind, std::optional<std::size_t> index = std::nullopt) const;

    const RobotSpec& spec_;
    std::unique_ptr<RobotBody> simulated_;
    OutPort<Velocity2D>* commanded_ = nullptr;
    std::vector<OutPortBase*> actuators_;  // index: actuator; null: it has no port
    std::vector<double> angles_;           // [rad] of servos, as commanded
    InPort<std::vector<std::int32_t>>* pulses_in_ = nullptr;
    InPort<Velocity2D>* velocity_in_ = nullptr;
    InPort<bool>* may_drive_in_ = nullptr;
    std::vector<Sensed> sensed_;
    std::vector<SensorReading> readings_;
    std::vector<std::vector<double>> values_;
    std::vector<Needed> needed_;
    std::vector<std::string> faults_;
    std::vector<bool> was_told_;  // index: as in sensed_; whether a wrong number of values was reported
    bool said_pulses_ = false;

    WheelReading wheels_;
    Wheels travelled_;  // [m] by a driver that writes velocities
    std::optional<std::vector<std::int32_t>> counted_;
    struct Counted {
        double tm;
        WheelPulses pulses;
    };
    std::deque<Counted> counts_;  // as far back as is needed to measure speeds

    // Only in simulation.
    OutPort<std::vector<std::int32_t>>* model_pulses_ = nullptr;
    std::vector<OutPortBase*> model_sensors_;
    InPort<Velocity2D>* model_drive_ = nullptr;
};

}  // namespace nezumi
