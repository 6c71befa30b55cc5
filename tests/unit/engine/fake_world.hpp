// A world without physics, whose robots do what they are told at once: what the tests of engine/ see the edge by.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/system/system.hpp"

namespace nezumi {

/// What a fake robot feels and was told, kept after the robot is gone.
struct FakeHull {
    std::string name;
    Wheels angles;
    std::vector<double> distances;                      ///< of the range sensors [m]; 0.6 where it is too short
    std::map<std::size_t, SensorReading> readings;      ///< what a sensor says in place of all that is below
    std::map<std::size_t, std::vector<double>> values;  ///< of sensors that have several
    bool has_encoders = true;
    double measured_late = 0;         ///< [s] by which all stamps are before now
    std::vector<std::string> faults;  ///< told at the next opportunity
    std::map<std::size_t, bool> pressed;
    double yaw_rate = 0;
    FloorColor color = FloorColor::none;
    double light = 0;
    double ambient = 0;

    Wheels speeds;
    std::vector<Wheels> all_speeds;
    bool coasting = false;
    bool powered = true;
    bool may_drive = true;
    std::optional<double> battery;  ///< [V]
    int power_calls = 0;
    std::vector<bool> leds;
    int led_calls = 0;
    int hertz = 0;
    std::map<std::size_t, double> servos;        ///< angles [rad] that they were sent to, and are at
    std::map<std::size_t, double> servo_speeds;  ///< [rad/s]
    std::vector<CameraImage> pictures;
    std::vector<Sound> sounds;
    int silences = 0;
};

/// Tells what its hull says, without noise: a device's reading.
class FakeBody final : public RobotBody {
public:
    FakeBody(FakeHull& hull, const RobotSpec& spec, RobotId id) : hull_(hull), spec_(spec), id_(id) {}
    RobotId id() const override { return id_; }
    WheelReading read_wheels(const Time& now, double period) override {
        const auto pulses = [&](double angle) {
            return static_cast<std::int64_t>(std::llround(angle / (2 * M_PI) * spec_.drive.encoder_pulses()));
        };
        const auto speed = [&](double angle, double before) { return (angle - before) * spec_.drive.radius / period; };
        WheelReading reading{.is_there = hull_.has_encoders,
                             .tm = now.seconds - hull_.measured_late,
                             .pulses = {pulses(hull_.angles.left), pulses(hull_.angles.right)},
                             .speeds = {}};
        if (before_)
            reading.speeds = {speed(hull_.angles.left, before_->left), speed(hull_.angles.right, before_->right)};
        before_ = hull_.angles;
        return reading;
    }
    std::span<const SensorReading> read_sensors(const Time& now, double /*period*/) override {
        readings_.clear();
        std::size_t ranges = 0;
        for (std::size_t i = 0; i < spec_.sensors.size(); ++i) {
            SensorReading reading{.is_there = true, .tm = now.seconds - hull_.measured_late, .value = 0, .physical = 0};
            switch (spec_.sensors[i].kind) {
                case SensorSpec::Kind::range:
                    reading.physical = ranges < hull_.distances.size() ? hull_.distances[ranges] : 0.6;
                    reading.value = std::round(1000 * reading.physical);
                    ++ranges;
                    break;
                case SensorSpec::Kind::gyro: reading.physical = hull_.yaw_rate; break;
                case SensorSpec::Kind::color: reading.value = static_cast<double>(hull_.color); break;
                case SensorSpec::Kind::reflect: reading.value = hull_.light; break;
                case SensorSpec::Kind::ambient: reading.value = hull_.ambient; break;
                default: reading.value = hull_.pressed[i] ? 1 : 0;
            }
            if (const auto said = hull_.readings.find(i); said != hull_.readings.end()) reading = said->second;
            readings_.push_back(reading);
        }
        return readings_;
    }
    std::span<const double> sensor_values(std::size_t index) const override { return hull_.values.at(index); }
    std::vector<std::string> take_faults() override { return std::exchange(hull_.faults, {}); }
    bool may_drive() const override { return hull_.may_drive; }
    std::optional<double> battery() const override { return hull_.battery; }
    double servo_angle(std::size_t index) const override { return hull_.servos[index]; }
    void set_wheel_speeds(Wheels speeds) override {
        hull_.speeds = speeds;
        hull_.all_speeds.push_back(speeds);
        hull_.coasting = false;
    }
    void coast() override { hull_.coasting = true; }
    void set_motor_power(bool on) override {
        hull_.powered = on;
        ++hull_.power_calls;
    }
    void aim_servo(std::size_t index, double angle, double speed) override {
        hull_.servos[index] = angle;
        hull_.servo_speeds[index] = speed;
    }
    void set_leds(const std::vector<bool>& on) override {
        hull_.leds = on;
        ++hull_.led_calls;
    }
    void set_buzzer(int hertz) override { hull_.hertz = hertz; }
    void show(std::size_t, const CameraImage& picture) override { hull_.pictures.push_back(picture); }
    void play(const Sound& sound) override { hull_.sounds.push_back(sound); }
    void silence() override { ++hull_.silences; }

private:
    FakeHull& hull_;
    const RobotSpec& spec_;
    RobotId id_;
    std::optional<Wheels> before_;
    std::vector<SensorReading> readings_;
};

class FakeWorld final : public World {
public:
    Expected<std::unique_ptr<RobotBody>> add_robot(const std::string& name, const RobotSpec& spec,
                                                   Pose2D pose) override {
        if (pose.position.x > 100) return failure("robot '" + name + "' overlaps box 1: move one of them");
        hulls.push_back(std::make_unique<FakeHull>());
        hulls.back()->name = name;
        return std::make_unique<FakeBody>(*hulls.back(), spec, hulls.size() - 1);
    }
    void step(int count) override { steps += count; }
    Truth truth(RobotId) const override { return {}; }
    bool collided(RobotId) const override { return false; }
    std::string collided_with(RobotId) const override { return ""; }
    Expected<void> teleport(RobotId, Pose2D) override { return {}; }
    void disturb(RobotId, const VelocityConstraint&) override {}
    void press(RobotId robot, std::size_t sensor, bool pressed) override { hulls[robot]->pressed[sensor] = pressed; }
    std::vector<ThingPose> things() const override { return {}; }
    std::vector<Ray> rays(RobotId) const override { return {}; }

    int steps = 0;
    std::vector<std::unique_ptr<FakeHull>> hulls;
};

/// A small mouse: two range sensors, one of them with a response, a gyro, a button, lights, a buzzer, a servo.
inline RobotSpec fake_mouse() {
    RobotSpec spec;
    spec.model = "mouse";
    spec.drive.radius = 0.02;
    spec.drive.track = 0.1;
    spec.drive.limits = {.speed = 0.5, .yaw_rate = 6, .acceleration = 2, .yaw_acceleration = 12};
    SensorSpec metre;
    metre.name = "metre";
    metre.range = 0.6;
    metre.minimum = 0.03;
    SensorSpec light = metre;
    light.name = "light";
    light.has_response = true;
    light.response = *ResponseTable::from_points({{0.1, 1000}, {0.3, 100}}, 0.6, 0, 0, 4095);
    SensorSpec gyro;
    gyro.name = "gyro";
    gyro.kind = SensorSpec::Kind::gyro;
    gyro.max_rate = 2;
    SensorSpec button;
    button.name = "button";
    button.kind = SensorSpec::Kind::button;
    spec.sensors = {metre, light, gyro, button};
    ActuatorSpec leds{.name = "leds", .kind = ActuatorSpec::Kind::leds, .count = 4};
    ActuatorSpec buzzer{.name = "buzzer", .kind = ActuatorSpec::Kind::buzzer};
    ActuatorSpec servo{.name = "neck", .kind = ActuatorSpec::Kind::servo, .minimum = -1, .maximum = 1};
    spec.actuators = {leds, buzzer, servo};
    const auto in = [&](const char* name, const char* type, const char* item, bool off_when_silent = false) {
        PortSpec port;
        port.name = name;
        port.is_input = true;
        port.type = type;
        port.items = {item};
        port.off_when_silent = off_when_silent;
        spec.ports.push_back(port);
    };
    const auto out = [&](const char* name, const char* type, std::vector<std::string> items,
                         PortSpec::Quantity quantity = PortSpec::Quantity::value) {
        PortSpec port;
        port.name = name;
        port.type = type;
        port.items = std::move(items);
        port.quantity = quantity;
        spec.ports.push_back(port);
    };
    in("velocity_in", "TimedVelocity2D", "drive");
    in("pose_in", "TimedPose2D", "odometry");
    in("leds_in", "TimedBooleanSeq", "leds");
    in("buzzer_in", "TimedShort", "buzzer", true);
    in("neck_in", "TimedDouble", "neck");
    out("velocity", "TimedVelocity2D", {"velocity"});
    out("pose", "TimedPose2D", {"odometry"});
    out("ir", "TimedShortSeq", {"light", "light"});
    out("ir_metre", "TimedDoubleSeq", {"metre", "light"}, PortSpec::Quantity::distance);
    out("yaw", "TimedDouble", {"gyro"});
    out("yaw_rate", "TimedDouble", {"gyro"}, PortSpec::Quantity::rate);
    out("buttons", "TimedBooleanSeq", {"button"});
    out("ranger", "RangeData", {"metre"});
    return spec;
}

/// A system with one fake mouse in it, ACTIVE.
struct FakeRun {
    explicit FakeRun(RobotSpec made = fake_mouse(), double rate = 100)
        : spec(std::move(made)),
          system({.rate = rate}, [this](const LogLine& line) { log.push_back(line.component + ": " + line.text); }) {
        auto world_made = std::make_unique<FakeWorld>();
        world = world_made.get();
        system.take_world(std::move(world_made));
        auto robot_made = Robot::make("mouse", spec, spec.drive.limits);
        if (!robot_made) throw std::runtime_error(robot_made.error().message);
        robot = robot_made->get();
        robot->take_body(std::move(*world->add_robot("mouse", spec, {})));
        static_cast<void>(system.add(std::move(*robot_made)));
        static_cast<void>(robot->activate(system.now()));
    }

    FakeHull& hull() { return *world->hulls[0]; }
    void ticks(int count) {
        for (int i = 0; i < count; ++i) system.tick();
    }
    /// Sends a value to an in-port of the mouse, then one tick.
    void send(std::string_view port, const Value& value) {
        robot->find_in_port(port)->inject(value);
        system.tick();
    }
    template <class T>
    T value(std::string_view port) {
        return robot->find_out_port(port)->value().template get<T>();
    }

    RobotSpec spec;
    std::vector<std::string> log;
    System system;
    FakeWorld* world = nullptr;
    Robot* robot = nullptr;
};

}  // namespace nezumi
