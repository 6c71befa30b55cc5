// A robot: ports, safety, odometry and sensors' values around a body, be it simulated or real.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/schedule.hpp"
#include "engine/components/component.hpp"
#include "engine/robot/actuators.hpp"
#include "engine/robot/odometry.hpp"
#include "engine/robot/sensor_values.hpp"
#include "engine/robot/velocity_guard.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

class Robot final : public Device {
public:
    /// Makes the ports that the spec lists; an error names the port that cannot be. `spec` must outlive the robot.
    static Expected<std::unique_ptr<Robot>> make(std::string name, const RobotSpec& spec, const Limits& limits,
                                                 RobotId id, std::uint64_t seed);
    /// Its body stops: nobody is left to drive it.
    ~Robot() override;
    /// The body it moves; given once, before the first tick.
    void take_body(std::unique_ptr<RobotBody> body) { body_ = std::move(body); }

    bool has_body() const { return body_ != nullptr; }
    RobotId id() const { return id_; }
    const RobotSpec& spec() const { return spec_; }
    const VelocityGuard& guard() const { return guard_; }
    const Odometry& odometry() const { return odometry_; }
    const std::vector<bool>& leds() const { return actuators_.leds(); }
    int buzzer_hertz() const { return actuators_.buzzer_hertz(); }
    /// What its speaker was given, oldest first, as far as it is kept.
    const std::deque<std::string>& said() const { return actuators_.said(); }

    void sense(const Time& now) override;
    void actuate(const Time& now) override;

private:
    // An out-port that carries sensors' values: how to write them, and which.
    struct SensorPort {
        OutPortBase* port;
        void (*write)(OutPortBase& port, const std::vector<double>& values, double rate, const Pose3D* turned);
        std::vector<std::size_t> sensors;
        bool distance;
        double rate;
        std::optional<std::size_t> servo;  // the actuator that turns its first sensor, where the message tells the pose
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
    Pose3D pose_on_servo(std::size_t sensor, std::size_t servo) const;
    void take_velocities(const Time& now);
    void command(const Velocity2D& velocity, const Time& now);
    void take_pose();
    void drive(const Time& now);

    const RobotSpec& spec_;
    RobotId id_;
    std::unique_ptr<RobotBody> body_;
    VelocityGuard guard_;
    Odometry odometry_;
    SensorValues sensors_;
    Actuators actuators_;
    Wheels angles_{};
    bool sensed_ = false;

    std::vector<SensorPort> sensor_ports_;
    std::vector<WheelPort<Velocity2D>> velocity_ports_;
    std::vector<WheelPort<Pose2D>> pose_ports_;
    InPort<Velocity2D>* velocity_in_ = nullptr;
    InPort<Pose2D>* pose_in_ = nullptr;
    std::vector<double> outgoing_;

    std::uint64_t seen_disconnections_ = 0;
    bool coasting_ = false;
    bool said_clamped_ = false;
    bool said_not_finite_ = false;
    bool said_sideways_ = false;
    bool said_lost_ = false;
};

}  // namespace nezumi
