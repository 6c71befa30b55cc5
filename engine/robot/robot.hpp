// A robot: ports, safety and odometry around a simulated or real body.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/schedule.hpp"
#include "engine/components/component.hpp"
#include "engine/robot/actuators.hpp"
#include "engine/robot/odometry.hpp"
#include "engine/robot/scripted_body.hpp"
#include "engine/robot/twin.hpp"
#include "engine/robot/velocity_guard.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

class Robot final : public Device {
public:
    /// Makes the ports of the spec; an error names the port that can't be made. `spec` must outlive the robot.
    static Expected<std::unique_ptr<Robot>> make(std::string name, const RobotSpec& spec, const Limits& limits);
    /// Stops the wheels, because nothing drives them any more.
    ~Robot() override;
    /// Sets the body of the robot; once, before the first tick.
    void take_body(std::unique_ptr<RobotBody> body);

    /// Makes the ports of a driver that is a behaviour, and sets a body that uses them; once, before the first tick.
    /// `simulated`: the robot's body in the world; null: the robot is real.
    void take_scripted_body(std::unique_ptr<RobotBody> simulated);
    /// Null if its driver is not a behaviour.
    ScriptedBody* scripted_body() { return scripted_; }
    const ScriptedBody* scripted_body() const { return scripted_; }

    /// Sets the pose at which the odometry starts.
    void set_odometry(const Pose2D& pose) { odometry_.start_at(pose); }

    /// Makes this simulated robot with a body the twin of a real one (`Twin`), with an out-port `error`. An error if it
    /// already has a port with this name.
    Expected<void> follow(const Robot& real, const World& world);
    /// Whether it is the twin of a real robot; `real` returns nullptr if the real robot is gone.
    bool is_twin() const { return twin_ != nullptr; }
    const Robot* real() const { return twin_ != nullptr ? twin_->real() : nullptr; }
    /// Must be called before the component `gone` is destroyed: it may be the real robot, the driver or a device.
    void forget(const Component& gone);

    /// Whether its motors have power: those of a real robot from its activation until it stands after an emergency
    /// stop, a deactivation or an error.
    bool has_power() const { return powered_; }
    bool has_body() const { return body_ != nullptr; }
    /// Its id in the world; `not_simulated` for a real robot.
    RobotId id() const { return body_->id(); }
    /// Whether its body is real.
    bool is_real() const { return id() == not_simulated; }
    const RobotSpec& spec() const { return spec_; }
    const VelocityGuard& guard() const { return guard_; }
    const Odometry& odometry() const { return odometry_; }
    const std::vector<bool>& leds() const { return actuators_.leds(); }
    int buzzer_hertz() const { return actuators_.buzzer_hertz(); }
    /// As in `RobotBody`.
    std::optional<double> battery() const { return has_body() ? body_->battery() : std::nullopt; }
    bool may_drive() const { return !has_body() || body_->may_drive(); }
    /// The texts for its speaker, oldest first, as far as they are stored.
    const std::deque<std::string>& said() const { return actuators_.said(); }
    /// The last readings of its sensors, in the order of the description; empty before it was ACTIVE, valid until the
    /// next tick.
    std::span<const SensorReading> readings() const { return readings_; }

    /// Brakes as hard as it can, then switches its motors off. Until `rearm` it ignores commands that would move it.
    void emergency_stop();
    /// Stops a real robot's wheels at the next `actuate`, without a braking ramp: the loop that drives it has stalled,
    /// and the surroundings may have changed. It obeys the next command.
    void halt() {
        if (is_real()) guard_.halt();
    }
    /// Obeys new commands again. The robot must stand when this is called.
    void rearm();
    /// Whether the wheels do not turn, and have no command to turn.
    bool stands() const;
    /// The velocity of its wheels in the last tick.
    const Velocity2D& measured() const { return measured_; }
    /// The time [s] of the reading from which `measured` comes; no value if there was none.
    const std::optional<double>& measured_at() const { return measured_at_; }
    /// The last commanded speeds [m/s] of the wheels; no value if the wheels roll freely.
    const std::optional<Wheels>& told() const { return told_; }
    /// Angle [rad] of servo `index` of the spec's actuators.
    double servo_angle(std::size_t index) const { return body_->servo_angle(index); }

    void sense(const Time& now) override;
    void actuate(const Time& now) override;

    /// At rest the robot brakes, stands and drops its commands. A real robot is at rest while its system is paused.
    void set_at_rest(bool at_rest) { at_rest_ = at_rest; }

    /// A required sensor without readings for this time [s] keeps the robot from driving.
    static constexpr double longest_blindness = 0.3;
    /// A loop without a tick for this time [s], or for three periods if that is longer, has stalled.
    static constexpr double shortest_stall = 0.2;

private:
    // An out-port with values of sensors: how to write them, and which.
    struct SensorPort {
        OutPortBase* port;
        void (*write)(const SensorPort& port, std::span<const SensorReading> readings, std::span<const double> values,
                      double rate, const Pose3D* turned);
        std::vector<std::size_t> sensors;
        // For a single sensor with several values: the first one and their number. 0: each sensor has one.
        std::size_t first, count;
        bool physical;  // the physical value instead of the value
        double rate;
        // For messages with a pose: the pose of its sensors in the body frame, and the servo that turns them.
        Pose3D pose;
        std::optional<std::size_t> servo;
    };
    // An out-port of a sensor of kind `neighbours`.
    struct NeighbourPort {
        OutPort<std::vector<Neighbour>>* port;
        std::size_t sensor;
        double rate;
    };
    // A sensor that is required for driving.
    struct Needed {
        std::size_t sensor;
        std::optional<double> heard_at{};  // [s] time of the last reading; before the first one: when waiting began
        bool was_heard = false;            // since the activation
        bool is_told = false;              // its silence was reported
    };
    // An out-port of the wheels.
    template <class T>
    struct WheelPort {
        OutPort<T>* port;
        double rate;
    };

    Robot(std::string name, const RobotSpec& spec, const Limits& limits);
    Expected<void> add_port(const PortSpec& port);
    Expected<void> add_output(const PortSpec& port);
    Expected<void> add_input(const PortSpec& port);
    Expected<void> add_servo_speeds();
    Expected<void> on_activated() override;

    bool is_due_at(double port_rate, const Time& now) const;
    double period_until(const Time& now, std::optional<double> last) const;
    void take_parameters();
    Velocity2D velocity_of(const WheelReading& wheels) const;
    void publish_wheels(const WheelReading& wheels, const Time& now);
    void publish(const SensorPort& port, std::span<const SensorReading> readings, const Time& now) const;
    void set_scans_due(const Time& now);
    Expected<void> add_neighbours(const PortSpec& port, const std::vector<std::size_t>& sensors);
    void publish_neighbours(const Time& now);
    void take_message(const Time& now);
    void say(std::span<const double> message);
    void publish_stalled();
    void tell_faults();
    Pose3D turned(const Pose3D& pose, std::size_t servo) const;
    void take_velocities(const Time& now);
    void forget_velocities();
    void command(const Velocity2D& velocity, const Time& now);
    void take_pose();
    void drive(const Time& now);
    void coast();
    void set_motor_power(bool on);
    bool hears_what_it_needs(const Time& now);
    void power_while_active(const Velocity2D& velocity, const Time& now);
    bool has_come_to_rest(const Time& now);

    const RobotSpec& spec_;
    std::unique_ptr<RobotBody> body_;
    ScriptedBody* scripted_ = nullptr;         // body_, if it is one
    std::span<const SensorReading> readings_;  // of body_
    VelocityGuard guard_;
    Odometry odometry_;
    Actuators actuators_;
    std::optional<double> sensed_at_, drove_at_;  // [s]

    std::vector<Needed> needed_;
    std::vector<SensorPort> sensor_ports_;
    std::vector<NeighbourPort> neighbour_ports_;
    std::vector<WheelPort<Velocity2D>> velocity_ports_;
    std::vector<WheelPort<Pose2D>> pose_ports_;
    OutPort<bool>* stalled_out_ = nullptr;
    bool stalled_ = false;
    // A scan or neighbours; its rays are cast if one of its ports is due.
    struct Scan {
        std::size_t sensor;
        bool is_due = true;
    };
    std::vector<Scan> scans_;
    InPort<Velocity2D>* velocity_in_ = nullptr;
    InPort<Pose2D>* pose_in_ = nullptr;
    InPort<std::vector<double>>* say_in_ = nullptr;
    bool is_quiet_when_silent_ = false;  // it stops saying its message after a time without messages to `say_in_`
    std::vector<double> message_;        // the message that the robot says to others
    std::vector<std::size_t> servos_;    // servos with a parameter for their speed, in the order of the parameters
    std::uint64_t parameters_version_ = 0;

    std::unique_ptr<Twin> twin_;  // null: it is not a twin
    Velocity2D measured_;
    std::optional<double> measured_at_;  // [s]
    std::optional<Wheels> told_;
    std::uint64_t seen_disconnections_ = 0;
    std::string note_before_stop_;  // of velocity_in_
    bool stopped_ = false;          // by an emergency stop
    bool powered_ = true;
    std::optional<double> braked_at_;  // [s] when the commanded velocity became 0; set while the robot is being stopped
    bool coasting_ = false;
    bool at_rest_ = false;
    bool said_clamped_ = false;
    bool said_not_finite_ = false;
    bool said_sideways_ = false;
    bool said_lost_ = false;
    bool said_long_ = false;
    bool said_deaf_ = false;
};

}  // namespace nezumi
