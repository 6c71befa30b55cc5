// The world of the robots, as the engine and scenarios see it: a simulation, or the real world with very little
// information.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"
#include "engine/ports/port_base.hpp"
#include "engine/world/arena_spec.hpp"
#include "engine/world/floor_color.hpp"
#include "engine/world/robot_spec.hpp"
#include "engine/world/sound.hpp"

namespace nezumi {

class CameraSource;
class WorkerPool;
struct CameraMount;
struct CameraSettings;

/// A robot of the world, in the order of adding, from 0.
using RobotId = std::size_t;

/// The id of a real robot, which no world simulates.
inline constexpr RobotId not_simulated = static_cast<RobotId>(-1);

/// One value for the left wheel and one for the right.
struct Wheels {
    double left = 0;
    double right = 0;
    bool operator==(const Wheels&) const = default;
};

/// Whole pulses of the encoders; forward is positive.
struct WheelPulses {
    std::int64_t left = 0;
    std::int64_t right = 0;
    bool operator==(const WheelPulses&) const = default;
};

/// A reading of the wheels' encoders.
struct WheelReading {
    bool is_there = false;  ///< whether there is a reading
    double tm = 0;          ///< [s] time of the reading
    WheelPulses pulses;     ///< since the start, `DriveSpec::encoder_pulses` per turn; without overflow
    Wheels speeds;          ///< [m/s] of the rims
};

/// A reading of a sensor, as the sensor's device gives it.
struct SensorReading {
    bool is_there = false;  ///< whether there is a reading; otherwise its port publishes nothing
    double tm = 0;          ///< [s] time of the measurement
    /// The value. Range: by its response; button and touch: 0 or 1; gyro: the angle [rad]; color: a `FloorColor`;
    /// reflect and ambient: 0 to 100.
    double value = 0;
    double physical = 0;  ///< the physical value: of a range sensor the distance [m], of a gyro the rate [rad/s]
};

/// One robot's hull, wheels and devices, which a driver or a simulator provides for the engine's `Robot`. `Robot` adds
/// ports, safety and odometry. No function here waits for a device: a reading is the latest one, and commands are sent
/// in the background. `read_wheels` is called in every tick. Several robots may be used at the same time by as many
/// threads, some sensing while others act: commands become effective in the next step of the world, and are invisible
/// to others before.
class RobotBody {
public:
    virtual ~RobotBody() = default;

    /// The id of this robot in the world, or `not_simulated`.
    virtual RobotId id() const = 0;

    /// The encoders at `now`, `period` [s] after the last call.
    virtual WheelReading read_wheels(const Time& now, double period) = 0;
    /// One reading for each sensor of the spec at `now`, in its order; valid until the next call. Called after
    /// `read_wheels`, and only while the robot is ACTIVE.
    virtual std::span<const SensorReading> read_sensors(const Time& now, double period) = 0;
    /// Sets whether the next `read_sensors` calls must compute the values of sensor `index` of the spec (a scan or
    /// neighbours): casting rays is the most expensive part of a tick. Applies until the next `set_due`.
    virtual void set_due(std::size_t /*index*/, bool /*due*/) {}
    /// The values of sensor `index` of the spec in the last `read_sensors`, if it has several: of a scan the distances
    /// [m] of its rays from right to left, of an imu three rates [rad/s] and three accelerations [m/s^2]. Empty for
    /// other sensors.
    virtual std::span<const double> sensor_values(std::size_t /*index*/) const { return {}; }
    /// The robots that sensor `index` of the spec, of kind `neighbours`, saw in the last `read_sensors`, nearest first.
    virtual std::span<const Neighbour> neighbours(std::size_t /*index*/) const { return {}; }
    /// Angle [rad] of servo `index` of the spec's actuators.
    virtual double servo_angle(std::size_t /*index*/) const { return 0; }
    /// The faults since the last call: one line each, with what to do, reported once. Everything else continues.
    virtual std::vector<std::string> take_faults() { return {}; }

    /// Whether the robot's power supply allows driving. If not, the robot brakes and stands, and `take_faults` gives
    /// the reason.
    virtual bool may_drive() const { return true; }
    /// The voltage [V] of the robot's battery, NaN while it is unknown. No value for a body that can't measure it, such
    /// as a simulated one.
    virtual std::optional<double> battery() const { return std::nullopt; }
    /// Whether a wheel's motor has full power but does not reach the commanded speed, as the driver reports.
    virtual bool is_stalled() const { return false; }

    /// Sets the surface speed [m/s] of each wheel from now on, already limited.
    virtual void set_wheel_speeds(Wheels speeds) = 0;
    /// Lets the wheels roll freely until the next `set_wheel_speeds`.
    virtual void coast() = 0;
    /// Switches the power of the motors; called on changes, at standstill. Without power the wheels roll freely.
    virtual void set_motor_power(bool /*on*/) {}
    /// Moves servo `index` of the spec's actuators to an angle [rad], already limited, at `speed` [rad/s] (0: as fast
    /// as possible). Called on changes.
    virtual void aim_servo(std::size_t index, double angle, double speed) = 0;
    /// Switches the lights, in their order. Cameras and `neighbours` see the change from the next step of the world on.
    /// Called on changes.
    virtual void set_leds(const std::vector<bool>& /*on*/) {}
    /// Sets the message that `neighbours` sensors of other robots receive from the next step of the world on: at most
    /// `longest_message` finite numbers. Called on changes.
    virtual void say(std::span<const double> /*message*/) {}
    static constexpr std::size_t longest_message = 10;
    /// Tone of the buzzer [Hz], 0 for silence; called on changes.
    virtual void set_buzzer(int /*hertz*/) {}
    /// Shows a picture, complete and not empty, on screen `index` of the spec's actuators.
    virtual void show(std::size_t /*index*/, const CameraImage& /*picture*/) {}
    /// Plays a sound after the earlier ones. Must not wait until it has been played.
    virtual void play(const Sound& /*sound*/) {}
    /// Stops the present sound, and drops the waiting ones.
    virtual void silence() {}
};

/// The true state of a robot, independent of its sensors.
struct Truth {
    Pose2D pose;
    Velocity2D velocity;  ///< in the robot's frame
    double height = 0;    ///< [m] of the body frame's origin over the floor
    double tilt = 0;      ///< [rad] between the body's z axis and the vertical

    static constexpr FieldList fields{
        Field{"pose", &Truth::pose, "", "where it is"},
        Field{"velocity", &Truth::velocity, "", "in the robot's frame"},
        Field{"height", &Truth::height, "m", "of the body frame's origin over the floor"},
        Field{"tilt", &Truth::tilt, "rad", "between the body's z axis and the vertical"},
    };
};

/// An object of the arena at its present pose, for pictures and cameras.
struct ThingPose {
    enum class Shape { box, cylinder };
    Shape shape = Shape::box;
    Point3D size{};  ///< [m] a box's edges, or diameter, diameter, height
    Pose3D pose;     ///< of its centre
    std::string color;
    std::string name;  ///< "box 1", "cylinder 2", ... as the arena lists them; "wall" of its border
};

/// A marker at its present pose. Its yaw is that of the outward normal, as in `MarkerSpec::facing`; pitch turns the
/// normal down, roll turns the marker about it.
struct MarkerPose {
    std::string name;
    int id = 0;
    double size = 0;  ///< [m] edge of the black border
    Pose3D pose;      ///< of its centre
};

/// The ray of a range sensor, for pictures.
struct Ray {
    Point3D from{};  ///< [m] in the world
    Point3D to{};    ///< [m] where it hits an object, or ends
    bool hit = false;
    std::size_t distance = 0;  ///< index of its distance among those of the robot's range sensors and scans
};

/// Velocities that are forced on a robot; those that are not set stay free.
struct VelocityConstraint {
    std::optional<double> vx;  ///< [m/s] along the robot's x axis
    std::optional<double> vy;  ///< [m/s]
    std::optional<double> va;  ///< [rad/s]
};

class World {
public:
    virtual ~World() = default;

    /// Adds a robot. The spec must outlive the world. The body must not outlive the world; destroying the body removes
    /// the robot. An error if the robot overlaps a robot or an object (the error names both), or if it is outside of
    /// an arena with a border.
    virtual Expected<std::unique_ptr<RobotBody>> add_robot(const std::string& name, const RobotSpec& spec,
                                                           Pose2D pose) = 0;

    /// Advances the world by `count` physics steps.
    virtual void step(int count) = 0;
    /// Sets threads that share the work of steps; null: none. They must exist in every step from now on. The result of
    /// a step does not depend on their number.
    virtual void use_threads(WorkerPool* /*threads*/) {}
    /// The reason why this world can't continue, after which nothing moves any more; null if it can continue.
    virtual const Error* breakdown() const { return nullptr; }

    /// The true state of a robot.
    virtual Truth truth(RobotId robot) const = 0;
    /// The full pose of a robot's body frame.
    virtual Pose3D pose(RobotId robot) const;
    /// Whether the robot touched anything except the floor during the last `step` call.
    virtual bool collided(RobotId robot) const = 0;
    /// The object that the robot touched during the last `step` call: a robot's name, "wall", "box 2", ...; empty if
    /// none.
    virtual std::string collided_with(RobotId robot) const = 0;
    /// The distance [m] from a robot to what it would touch first, seen from above; 0 where they overlap. At most
    /// `most`: a smaller limit takes less time. Things above the robot do not count. No value if this world can't
    /// compute it.
    virtual std::optional<double> clearance(RobotId /*robot*/, double /*most*/) const { return std::nullopt; }
    static constexpr double most_clearance = 1.0;  ///< [m]
    /// The points [m] where the robot touched objects: those of the last `step` call, from its latest physics step with
    /// a contact. Empty without contacts, and in a world that can't compute them.
    virtual std::vector<Point3D> contact_points(RobotId /*robot*/) const { return {}; }

    /// Moves a robot to a pose, at rest, without changing its odometry. An error if the place is occupied, or outside
    /// of an arena with a border.
    virtual Expected<void> teleport(RobotId robot, Pose2D pose) = 0;
    /// Forces these velocities on the robot until the next call; an empty constraint ends it.
    virtual void disturb(RobotId robot, const VelocityConstraint& constraint) = 0;
    /// Presses or releases a button or touch sensor, by its index in the spec's sensors.
    virtual void press(RobotId robot, std::size_t sensor, bool pressed) = 0;

    /// Walls, boxes and cylinders at their present poses.
    virtual std::vector<ThingPose> things() const = 0;
    /// Moves a box or cylinder to a pose, at rest, except the walls of the arena's border. Its height and tilt do not
    /// change. An error if there is none with this name (suggests a similar one), if the place is outside of an arena
    /// with a border, or if it would overlap a robot or a movable object; a movable one must not overlap anything.
    virtual Expected<void> move_thing(std::string_view name, const Pose2D& pose);
    /// The arena's markers at their present poses, in the order of the arena.
    virtual std::vector<MarkerPose> markers() const { return {}; }
    /// The pattern of a marker with this id: rows of cells within the outer edges of its black border, from the top
    /// left, '1' for white; empty if there is none.
    virtual std::vector<std::string> marker_cells(int /*id*/) const { return {}; }
    /// Moves a marker to any pose, because a marker touches nothing. An error if there is none with this name
    /// (suggests a similar one), or if the pose is not finite.
    virtual Expected<void> move_marker(std::string_view name, const Pose3D& pose);
    /// Adds a marker. An error if its name is taken, or if it could not be seen.
    virtual Expected<void> add_marker(const MarkerSpec& marker);
    /// Removes a marker. An error if there is none with this name (suggests a similar one).
    virtual Expected<void> remove_marker(std::string_view name);
    /// Opens a camera in this world, which must outlive the camera. An error if this world has no view for cameras, or
    /// if there is no such robot.
    virtual Expected<std::unique_ptr<CameraSource>> open_camera(const CameraMount& mount,
                                                                const CameraSettings& settings);
    /// The present rays of the robot's range sensors.
    virtual std::vector<Ray> rays(RobotId robot) const = 0;
};

/// Settings of the physics.
struct PhysicsSpec {
    double step = 0.005;     ///< [s] fixed, independent of every rate
    std::uint64_t seed = 0;  ///< for all random numbers
};

/// Makes a world with this arena. Warnings go to `warn`.
using WorldFactory = std::function<Expected<std::unique_ptr<World>>(const ArenaSpec& arena, const PhysicsSpec& physics,
                                                                    std::function<void(const std::string&)> warn)>;

}  // namespace nezumi
