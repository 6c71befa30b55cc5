// A robot's body as a device: exact measurements become readings with response curves, noise, drift and encoder pulses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/world/world.hpp"

namespace nezumi::sim {

/// The motion of a point on a robot.
struct PlaceMotion {
    std::array<Point3D, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< axes x, y, z of its frame, in the world frame
    Point3D velocity{};                                              ///< [m/s] in the world frame
    Point3D spin{};                                                  ///< [rad/s] in the world frame
};

/// What others see and hear of a robot.
struct Signals {
    std::vector<double> message;
    std::vector<bool> leds;
};

/// A derived class provides the true values. This class computes from them what the robot's devices would report.
class SimulatedBody : public RobotBody {
public:
    /// `spec` must outlive this object. The same `seed` gives the same noise.
    SimulatedBody(const RobotSpec& spec, std::uint64_t seed);

    /// Angle [rad] of each wheel since the start, forward positive, not wrapped.
    virtual Wheels wheel_angles() const = 0;
    /// Distances [m] seen by the range sensors and scans of the spec, in its order, one for each range sensor and one
    /// for each ray of a scan; infinity: nothing in sight. If `due` is 0 for a distance, it is not needed; empty: all
    /// are needed.
    virtual void read_ranges(std::span<double> distances, std::span<const std::uint8_t> due) const = 0;
    void read_ranges(std::span<double> distances) const { read_ranges(distances, {}); }
    /// Whether sensor `index` of the spec (a button or touch sensor) is closed.
    virtual bool is_pressed(std::size_t index) const = 0;
    /// Yaw rate [rad/s] of the hull, as a gyro measures it.
    virtual double yaw_rate() const = 0;
    /// The motion at sensor `index` of the spec (an IMU).
    virtual PlaceMotion motion(std::size_t index) const = 0;
    /// The floor's colour at sensor `index` of the spec.
    virtual FloorColor floor_color(std::size_t index) const = 0;
    /// Light reflected by the floor at sensor `index` of the spec: 0 (none) to 100 (white paper).
    virtual double reflected_light(std::size_t index) const = 0;
    /// A robot in sight of a sensor. Name and signals are valid until the next step of the world.
    struct InSight {
        RobotId id;
        double range;    // [m]
        double bearing;  // [rad]
        std::string_view name;
        const Signals* signals;
    };
    /// Appends the robots that sensor `index` of the spec (neighbours) sees, in any order.
    virtual void list_neighbours(std::size_t index, std::vector<InSight>& seen) const = 0;
    /// Sets actuator `index` of the spec (a servo) to an angle [rad] at once.
    virtual void set_servo(std::size_t index, double angle) = 0;

    WheelReading read_wheels(const Time& now, double period) final;
    std::span<const SensorReading> read_sensors(const Time& now, double period) final;
    void set_due(std::size_t index, bool due) final;
    std::span<const double> sensor_values(std::size_t index) const final;
    std::span<const Neighbour> neighbours(std::size_t index) const final;
    double servo_angle(std::size_t index) const final;
    void aim_servo(std::size_t index, double angle, double speed) final;

private:
    struct Servo {
        double angle = 0;   // [rad]
        double wanted = 0;  // [rad]
        double speed = 0;   // [rad/s]; 0: no limit
    };

    // Identifies a random number.
    struct Draw {
        std::size_t sensor;
        std::int64_t tick;
        std::size_t part = 0;  // index within the sensor's values of this tick
    };

    std::uint64_t hash_of(const Draw& draw) const;
    /// Adds noise of the sensor's own `deviation` and of the robot's `noise`, which is relative to the value.
    double with_noise(const Draw& draw, double value, double deviation) const;
    double seen_by(const SensorSpec& sensor, const Draw& draw, double distance) const;
    void measure_range(const Draw& draw, double seen, SensorReading& reading) const;
    void measure_motion(std::int64_t tick, double period);
    void look_around(std::int64_t tick);
    void turn_servos(double period);
    // The index of a sensor's first ray among all rays.
    std::size_t first_ray(std::size_t index) const;

    const RobotSpec& spec_;
    std::uint64_t seed_;
    // An IMU: its index in the spec, its reading, and its last velocity [m/s].
    struct Inertial {
        std::size_t sensor;
        std::array<double, 6> values{};
        std::optional<Point3D> before{};
    };

    std::size_t rays_ = 0;           // of all range sensors and scans, in the order of the spec
    std::vector<double> seen_;       // distances seen by these rays; empty if they are few and without a scan
    std::vector<std::uint8_t> due_;  // whether each distance is needed now; empty: all are
    std::vector<double> fresh_;      // distances, while not all are due
    std::vector<Inertial> inertial_;
    // A sensor of kind neighbours.
    struct Around {
        std::size_t sensor;
        bool is_due = true;
        std::vector<InSight> in_sight{};
        std::vector<Neighbour> seen{};
    };
    std::vector<Around> around_;
    std::vector<SensorReading> readings_;  // of all sensors
    std::vector<Servo> servos_;            // by actuator of the spec
    Wheels angles_;                        // [rad] at the last call of read_wheels
    bool has_read_wheels_ = false;
    bool servos_turn_ = false;
    double gyro_angle_ = 0;
};

}  // namespace nezumi::sim
