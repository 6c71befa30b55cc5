// The world behind the robots, as the engine and scenarios see it: a simulation, or the real one with next to no
// answers.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
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

/// The id of a robot that no world simulates: a real one.
inline constexpr RobotId not_simulated = static_cast<RobotId>(-1);

/// One value for the left wheel and one for the right.
struct Wheels {
    double left = 0;
    double right = 0;
    bool operator==(const Wheels&) const = default;
};

/// Whole pulses of the encoders, forward positive.
struct WheelPulses {
    std::int64_t left = 0;
    std::int64_t right = 0;
    bool operator==(const WheelPulses&) const = default;
};

/// What the wheels' encoders say.
struct WheelReading {
    bool is_there = false;  ///< whether they say anything
    double tm = 0;          ///< [s] when they were read
    WheelPulses pulses;     ///< since the start, `DriveSpec::encoder_pulses` a turn; not wrapped
    Wheels speeds;          ///< [m/s] of the rims
};

/// What a sensor says, as its device has it.
struct SensorReading {
    bool is_there = false;  ///< whether it says anything; a port whose sensor does not is silent
    double tm = 0;          ///< [s] when it was measured
    double value = 0;       ///< what its response makes of it, 0 or 1, an angle [rad], a `FloorColor`, 0 to 100
    double physical = 0;    ///< behind that value: of a range sensor the distance [m], of a gyro the rate [rad/s]
};

/// One robot's hull, wheels and devices: what a driver or a simulator gives to the engine's `Robot`, which adds ports,
/// safety and odometry. Nothing here waits for a device: what is read is what came last, what is set goes out by
/// itself. Called once or more a tick; several robots at once on as many threads, some sensing while others act: what
/// is set takes effect in the world's next step, and nobody else sees it before.
class RobotBody {
public:
    virtual ~RobotBody() = default;

    /// What the world calls this robot, or `not_simulated`.
    virtual RobotId id() const = 0;

    /// The encoders at `now`, `period` [s] after the last call.
    virtual WheelReading read_wheels(const Time& now, double period) = 0;
    /// All sensors of the spec at `now`, in its order, one reading for each; good until the next call. Comes after
    /// `read_wheels`, and not while the robot is not ACTIVE.
    virtual std::span<const SensorReading> read_sensors(const Time& now, double period) = 0;
    /// Whether somebody takes what scan `index` of the spec says in the next `read_sensors` calls: casting its rays is
    /// the dearest part of a tick. It is taken until this says otherwise.
    virtual void set_due(std::size_t /*index*/, bool /*due*/) {}
    /// What sensor `index` of the spec said in that call, of which one value is not all: of a scan the distances [m] of
    /// its rays from right to left, of an imu three rates [rad/s] and three accelerations [m/s^2]. Empty for others.
    virtual std::span<const double> sensor_values(std::size_t /*index*/) const { return {}; }
    /// Angle [rad] of servo `index` of the spec's actuators.
    virtual double servo_angle(std::size_t /*index*/) const { return 0; }
    /// What has failed since the last call: one line for each with what to do about it, told once. The rest goes on.
    virtual std::vector<std::string> take_faults() { return {}; }

    /// Whether its supply lets it drive. Where it does not the robot brakes and stands, and `take_faults` says why.
    virtual bool may_drive() const { return true; }
    /// Whether a wheel's motor gives all its power and does not get its speed, as its driver says.
    virtual bool is_stalled() const { return false; }

    /// Surface speed [m/s] of each wheel to hold from now on, already limited.
    virtual void set_wheel_speeds(Wheels speeds) = 0;
    /// Lets the wheels roll freely until the next `set_wheel_speeds`.
    virtual void coast() = 0;
    /// Power of the motors; called when it changes, at standstill. Without power the wheels roll freely.
    virtual void set_motor_power(bool /*on*/) {}
    /// Sends servo `index` of the spec's actuators to an angle [rad], already limited, at `speed` [rad/s] (0: as fast
    /// as it can). Called when one of them changes.
    virtual void aim_servo(std::size_t index, double angle, double speed) = 0;
    /// Lights, in order; called when one changes.
    virtual void set_leds(const std::vector<bool>& /*on*/) {}
    /// Tone of the buzzer [Hz], 0 for silence; called when it changes.
    virtual void set_buzzer(int /*hertz*/) {}
    /// Shows a picture, whole and not empty, on screen `index` of the spec's actuators.
    virtual void show(std::size_t /*index*/, const CameraImage& /*picture*/) {}
    /// Plays a sound after those that came before. Must not wait until it has been played.
    virtual void play(const Sound& /*sound*/) {}
    /// Ends the sound that plays, and forgets those that wait.
    virtual void silence() {}
};

/// What a world knows of a robot and no sensor tells.
struct Truth {
    Pose2D pose;
    Velocity2D velocity;  ///< in the robot's frame
    double height = 0;    ///< [m] of the body frame's origin over the floor
    double tilt = 0;      ///< [rad] between the body's z axis and the vertical

    static constexpr std::tuple fields{
        Field{"pose", &Truth::pose, "", "where it is"},
        Field{"velocity", &Truth::velocity, "", "in the robot's frame"},
        Field{"height", &Truth::height, "m", "of the body frame's origin over the floor"},
        Field{"tilt", &Truth::tilt, "rad", "between the body's z axis and the vertical"},
    };
};

/// A thing of the arena where it is now: for pictures and cameras.
struct ThingPose {
    enum class Shape { box, cylinder };
    Shape shape = Shape::box;
    Point3D size{};  ///< [m] a box's edges, or diameter, diameter, height
    Pose3D pose;     ///< of its centre
    std::string color;
    std::string name;  ///< "box 1", "cylinder 2", ... as the arena lists them; "wall" of its border
};

/// A marker where it is now. Its yaw is that of the outward normal, as `MarkerSpec::facing`; a pitch turns the normal
/// down, a roll turns the marker about it.
struct MarkerPose {
    std::string name;
    int id = 0;
    double size = 0;  ///< [m] edge of the black border
    Pose3D pose;      ///< of its centre
};

/// What a range sensor's ray goes through: for pictures.
struct Ray {
    Point3D from{};  ///< [m] in the world
    Point3D to{};    ///< [m] where it hits or ends
    bool hit = false;
    std::size_t distance = 0;  ///< which distance of the robot's range sensors and scans it measures
};

/// Velocities forced on a robot from outside; what is not set stays free.
struct VelocityConstraint {
    std::optional<double> vx;  ///< [m/s] along the robot's x axis
    std::optional<double> vy;  ///< [m/s]
    std::optional<double> va;  ///< [rad/s]
};

class World {
public:
    virtual ~World() = default;

    /// Puts a robot on the floor. The spec must outlive the world. The body must not outlive the world; destroying it
    /// takes the robot out of the world. An error when it overlaps a robot or a thing that is already there, naming
    /// both, or when it is outside of an arena with a border.
    virtual Expected<std::unique_ptr<RobotBody>> add_robot(const std::string& name, const RobotSpec& spec,
                                                           Pose2D pose) = 0;

    /// Advances by this many physics steps.
    virtual void step(int count) = 0;
    /// Threads that may share out its steps, and that must be there in every step from now on; null: none. The result
    /// is the same with any number.
    virtual void use_threads(WorkerPool* /*threads*/) {}
    /// Why it can't go on, once it can't: nothing moves any more.
    virtual const Error* breakdown() const { return nullptr; }

    /// The truth about a robot.
    virtual Truth truth(RobotId robot) const = 0;
    /// The whole pose of a robot's body frame.
    virtual Pose3D pose(RobotId robot) const;
    /// Whether the robot touched anything but the floor during the last `step` call.
    virtual bool collided(RobotId robot) const = 0;
    /// What the robot touched during the last `step` call: a robot's name, "wall", "box 2", ...; empty when nothing.
    virtual std::string collided_with(RobotId robot) const = 0;
    /// Where it touched that and whatever else [m], in the latest physics step of the last `step` call in which it did.
    /// Empty when it touched nothing, and in a world that does not know.
    virtual std::vector<Point3D> contact_points(RobotId /*robot*/) const { return {}; }

    /// Puts a robot elsewhere, at rest. The odometry is not told. An error when the place is taken, or outside of an
    /// arena with a border.
    virtual Expected<void> teleport(RobotId robot, Pose2D pose) = 0;
    /// Forces these velocities on the robot until the next call; an empty constraint lets go.
    virtual void disturb(RobotId robot, const VelocityConstraint& constraint) = 0;
    /// Presses or lets go of a button or touch sensor, by its index in the spec's sensors.
    virtual void press(RobotId robot, std::size_t sensor, bool pressed) = 0;

    /// Walls, boxes and cylinders where they are now.
    virtual std::vector<ThingPose> things() const = 0;
    /// Carries a box or cylinder elsewhere, at rest; a wall of the arena's border stays. Its height and tilt stay as
    /// they are. An error when there is none of this name, which names the nearest, when the place is outside of an
    /// arena with a border, and when it would lie in a robot or in a thing that can move; one that can move itself, in
    /// anything.
    virtual Expected<void> move_thing(std::string_view name, const Pose2D& pose);
    /// The arena's markers where they are now, in the order of the arena.
    virtual std::vector<MarkerPose> markers() const { return {}; }
    /// What a marker of this id looks like: the rows of cells within its black border's outer edges, from the top left,
    /// '1' for white; empty when there is none.
    virtual std::vector<std::string> marker_cells(int /*id*/) const { return {}; }
    /// Carries a marker elsewhere, wherever that is: a marker touches nothing. An error when there is none of this
    /// name, which names the nearest, or when the pose is not finite.
    virtual Expected<void> move_marker(std::string_view name, const Pose3D& pose);
    /// Hangs up another marker. An error when its name is taken, or when it is none that can be seen.
    virtual Expected<void> add_marker(const MarkerSpec& marker);
    /// Takes a marker away. An error when there is none of this name, which names the nearest.
    virtual Expected<void> remove_marker(std::string_view name);
    /// A camera that looks at this world; must not outlive it. An error when there is nothing that can be looked at, or
    /// no such robot.
    virtual Expected<std::unique_ptr<CameraSource>> open_camera(const CameraMount& mount,
                                                                const CameraSettings& settings);
    /// The rays of the robot's range sensors as they are now.
    virtual std::vector<Ray> rays(RobotId robot) const = 0;
};

/// How the physics of a world runs.
struct PhysicsSpec {
    double step = 0.005;     ///< [s] fixed, independent of every rate
    std::uint64_t seed = 0;  ///< decides everything that is drawn at random
};

/// Makes a world with this arena in it. Warnings go to `warn`.
using WorldFactory = std::function<Expected<std::unique_ptr<World>>(const ArenaSpec& arena, const PhysicsSpec& physics,
                                                                    std::function<void(const std::string&)> warn)>;

}  // namespace nezumi
