// A robot: ports, safety, odometry and sensors' values around a body, be it simulated or real.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/component.hpp"
#include "engine/odometry.hpp"
#include "engine/system_spec.hpp"
#include "engine/velocity_guard.hpp"
#include "engine/world.hpp"

namespace nezumi {

class Robot final : public Device {
public:
    /// Makes the ports that the spec lists; an error names the port that cannot be. `spec` must outlive the robot.
    static Expected<std::unique_ptr<Robot>> make(std::string name, const RobotSpec& spec, const Limits& limits,
                                                 RobotId id, std::uint64_t seed);
    /// The body it moves; given once, before the first tick.
    void take_body(std::unique_ptr<RobotBody> body) { body_ = std::move(body); }

    RobotId id() const { return id_; }
    const RobotSpec& spec() const { return spec_; }
    const VelocityGuard& guard() const { return guard_; }
    const Odometry& odometry() const { return odometry_; }
    const std::vector<bool>& leds() const { return leds_; }
    int buzzer_hertz() const { return buzzer_hertz_; }

    void sense(const Time& now) override;
    void actuate(const Time& now) override;

private:
    // An out-port that carries sensors' values: how to write them, and which.
    struct SensorPort {
        OutPortBase* port;
        void (*write)(OutPortBase& port, const std::vector<double>& values);
        std::vector<std::size_t> sensors;
        bool distance;
        double rate;
    };
    // An out-port of the wheels.
    template <class T>
    struct WheelPort {
        OutPort<T>* port;
        double rate;
    };

    Robot(std::string name, const RobotSpec& spec, const Limits& limits, RobotId id, std::uint64_t seed);
    Expected<void> add_port(const PortSpec& port);
    Expected<void> add_output(const PortSpec& port);
    Expected<void> add_input(const PortSpec& port);
    Expected<void> on_activated() override;

    bool is_due_at(double port_rate, const Time& now) const;
    void read_sensors(const Time& now);
    double with_noise(std::size_t sensor, double value, std::int64_t tick) const;
    void take_velocity(const Time& now);
    void drive(const Time& now);
    void act_on_devices(const Time& now);

    const RobotSpec& spec_;
    RobotId id_;
    std::uint64_t seed_;
    std::unique_ptr<RobotBody> body_;
    VelocityGuard guard_;
    Odometry odometry_;
    Wheels angles_{};
    bool sensed_ = false;

    std::vector<SensorPort> sensor_ports_;
    std::vector<WheelPort<Velocity2D>> velocity_ports_;
    std::vector<WheelPort<Pose2D>> pose_ports_;
    InPort<Velocity2D>* velocity_in_ = nullptr;
    InPort<Pose2D>* pose_in_ = nullptr;
    InPort<std::int16_t>* buzzer_in_ = nullptr;
    InPort<std::vector<bool>>* leds_in_ = nullptr;
    struct Servo {
        InPort<double>* port;
        std::size_t actuator;
    };
    std::vector<Servo> servos_;

    std::vector<std::size_t> range_sensors_;  // indices into spec_.sensors, in order
    std::vector<double> distances_;           // of the range sensors
    std::vector<double> values_;              // of all sensors
    std::vector<double> lengths_;             // of all sensors: distances, where they have one
    std::vector<double> outgoing_;
    double gyro_angle_ = 0;

    std::vector<bool> leds_;
    int buzzer_hertz_ = 0;
    bool coasting_ = false;
    bool was_connected_ = false;
    bool said_clamped_ = false;
    bool said_not_finite_ = false;
    bool said_sideways_ = false;
};

}  // namespace nezumi
