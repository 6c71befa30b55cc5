// The description of a robot model: geometry, wheels, limits, sensors, actuators and ports, from a robot file.
#pragma once

#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/components/parameter.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi {

/// Limits of velocity commands. All values are magnitudes and positive.
struct Limits {
    double speed = 0.5;              ///< [m/s] along x, both ways
    double yaw_rate = 6.0;           ///< [rad/s]
    double acceleration = 2.0;       ///< [m/s^2]
    double yaw_acceleration = 12.0;  ///< [rad/s^2]

    bool operator==(const Limits&) const = default;
};

/// The robot's hull. The body frame has x forward, y left, z up, its origin on the wheels' axis on the floor.
struct BodySpec {
    enum class Shape { box, cylinder };
    Shape shape = Shape::box;
    Point3D size{0.1, 0.1, 0.06};  ///< [m] a box: length, width, height; a cylinder: diameter, diameter, height
    Point3D at{0, 0, 0.04};        ///< [m] the hull's centre in the body frame
};

/// Two driven wheels on one axis, and skids in front of them and behind.
struct DriveSpec {
    double radius = 0.024;                ///< [m] wheel radius
    double left_radius = 0;               ///< [m] if the wheels are known to differ; 0: `radius`
    double right_radius = 0;              ///< [m] the same
    double track = 0.0925;                ///< [m] distance between the wheels' contact points
    double pulses_per_turn = 0;           ///< encoder pulses per turn of a wheel; 0: the encoder is continuous
    double skid = 0.04;                   ///< [m] distance of the skids from the axis
    bool coasts_until_commanded = false;  ///< the wheels roll freely until the first command after activation
    Limits limits{};                      ///< in simulation
    Limits hardware_limits{};             ///< on hardware, until the odometry is calibrated
    std::vector<std::string> needs;       ///< sensors that must work, or the robot does not drive
    std::vector<std::string> port;        ///< devices of the real left and right motor; empty: the driver's defaults

    /// Pulses per turn of a wheel in a `RobotBody`; a continuous encoder has steps of less than 0.4 urad.
    double encoder_pulses() const { return pulses_per_turn > 0 ? pulses_per_turn : 1 << 24; }
    double radius_of_left() const { return left_radius > 0 ? left_radius : radius; }
    double radius_of_right() const { return right_radius > 0 ? right_radius : radius; }
};

/// Converts a distance to a sensor's value by linear interpolation.
class ResponseTable {
public:
    struct Point {
        double distance;  ///< [m]
        double value;
    };

    /// Points in ascending order of distance, at least two; the table goes exactly through them. `minimum` and
    /// `maximum` limit every value. Beyond the last point, the value goes linearly to `nothing` at `range`. Before the
    /// first point, it follows a power law through the first two points (or a line, if a power law is impossible). If
    /// `range` is nearer than the last point, the sensor sees nothing beyond `range`. An error if the points are too
    /// few, not in order or not finite.
    static Expected<ResponseTable> from_points(std::vector<Point> points, double range, double nothing, double minimum,
                                               double maximum);

    /// Values at 0, h, 2h, ... range (at least two, all finite); `nothing` is the value without an object in sight.
    static ResponseTable from_samples(std::vector<double> samples, double range, double nothing);

    /// This table with other points. `nothing` and the limits stay, unless the points are beyond them. Errors as in
    /// `from_points`.
    Expected<ResponseTable> with_points(std::vector<Point> points, double range) const;

    /// The value at this distance [m]; infinity, or anything beyond the range, means no object.
    double operator()(double distance) const;

    /// A value limited to `minimum` and `maximum`, for values with noise.
    double clamp(double value) const { return value < minimum_ ? minimum_ : value > maximum_ ? maximum_ : value; }

    double range() const { return range_; }      ///< [m] beyond it no object is in sight
    double nothing() const { return nothing_; }  ///< the value without an object in sight

private:
    std::vector<Point> points_;    // for a table of points
    std::vector<double> samples_;  // for equidistant samples
    double range_ = 0;
    double nothing_ = 0;
    double minimum_ = -std::numeric_limits<double>::infinity();
    double maximum_ = std::numeric_limits<double>::infinity();
    double exponent_ = 0;  // of the power law before the first point; 0: a straight line
    double samples_per_metre_ = 0;
};

/// The distance [m] for a value of this response, which must rise or fall monotonically with the distance.
double distance_at(const ResponseTable& response, double value);

/// The points of a response table in CSV: columns `distance_m` (ascending, not negative) and `value`. Errors have
/// `file`.
Expected<std::vector<ResponseTable::Point>> read_csv_response(std::string_view text, const std::string& file);

/// One sensor. `kind` determines which fields are used.
struct SensorSpec {
    enum class Kind {
        range,    ///< a ray (or a cone of rays) that measures a distance
        button,   ///< a switch that a finger presses
        touch,    ///< a bumper that closes by contact
        gyro,     ///< yaw angle [rad]
        color,    ///< the colour of the floor, a `FloorColor`
        reflect,  ///< light reflected by the floor, 0 to 100
        ambient,  ///< light of the room, 0 to 100
        scan,     ///< a scanner in the plane: a distance for each of its rays
        imu,      ///< rates of turning [rad/s] about x, y, z, and measured accelerations [m/s^2] along them, including
                  ///< gravity
        neighbours,  ///< the robots around it, and what they say
    };

    std::string name;
    Kind kind = Kind::range;
    Point3D at{};                   ///< [m] in the body frame
    double yaw = 0;                 ///< [rad] direction of the ray in the body frame
    double range = 0.6;             ///< [m] maximum distance of a range sensor
    double minimum = 0;             ///< [m] minimum distance of a range sensor
    double cone = 0;                ///< [rad] full opening angle; 0: a single ray. For a scan, its field of view
    int rays = 1;                   ///< rays spread evenly over the cone; the nearest hit counts. For a scan, all count
    double noise = 0;               ///< standard deviation, in units of the value; for an imu, of its rates
    double acceleration_noise = 0;  ///< imu: [m/s^2] standard deviation of its accelerations
    double drift = 0;               ///< gyro: [rad/s]
    double max_rate = 0;            ///< gyro: [rad/s] largest rate; 0: no limit
    double travel = 0;              ///< touch: [m] way that it is pushed in until it closes
    double level = 0;               ///< ambient: light of the simulated room, 0 to 100
    double radius = 1;              ///< neighbours: [m] largest distance at which it sees robots
    double bearing_noise = 0;       ///< neighbours: [rad] standard deviation of its bearings
    double loss = 0;                ///< neighbours: probability that it misses a robot, each time
    std::string on;                 ///< the actuator that carries it, or "" for the hull
    ResponseTable response;         ///< range: from distance to value
    bool has_response = false;      ///< without a response, the value is the distance itself
    std::string port;               ///< which device of the real robot it is; "": the driver's own choice
};

/// The directions of the rays of a scan.
struct ScanAngles {
    double first = 0;  ///< [rad] of the first ray relative to the scanner: the rightmost ray
    double step = 0;   ///< [rad] from each ray to the next, counter-clockwise
};

/// The angles of a scan with at least two rays. In a full turn, the last ray is one step from the first, not on it.
inline ScanAngles angles_of(const SensorSpec& scan) {
    const bool is_closed = scan.cone > 2 * std::numbers::pi - 1e-6;
    return {-scan.cone / 2, scan.cone / (is_closed ? scan.rays : scan.rays - 1)};
}

/// One actuator in addition to the wheels.
struct ActuatorSpec {
    enum class Kind { leds, buzzer, servo, screen, speaker };
    std::string name;
    Kind kind = Kind::leds;
    int count = 1;                    ///< leds: how many
    double max_rate = 0;              ///< servo: [rad/s] largest speed; 0: no limit
    double speed = 0;                 ///< servo: [rad/s] default speed; 0: as fast as possible
    double minimum = 0, maximum = 0;  ///< servo: [rad]; equal: unlimited
    Point3D at{};                     ///< servo: [m] its axis in the body frame
    std::string port;                 ///< which device of the real robot it is; "": the driver's own choice
};

/// One port of the robot, and its use.
struct PortSpec {
    std::string name;
    bool is_input = false;
    std::string type;                ///< name of a message type
    std::vector<std::string> items;  ///< what it carries: sensors' or an actuator's names, or one of "velocity",
                                     ///< "odometry", "stalled", "drive", "say"
    enum class Quantity { value, distance, rate, acceleration } quantity = Quantity::value;
    double rate = 0;               ///< [Hz] of an out-port; 0: every tick
    std::uint32_t queue = 0;       ///< length of an in-port's queue; 0: the latest value
    bool off_when_silent = false;  ///< in-port of an actuator: off after `silence` seconds without a message
    std::string doc;
};

/// A device that the script of a robot's driver speaks to: `line = serial { ... }`.
struct DeviceSpec {
    std::string name;
    std::string type;        ///< of the component that is made for the device: "Serial"
    ParameterValues config;  ///< of this component
    Place place;
};

/// The backend of a real robot whose driver is a script.
inline constexpr std::string_view scripted = "script";

/// The connection to the real robot.
struct HardwareSpec {
    std::string driver;               ///< key of `Makers::bodies`; "": there is none in C++
    std::string script;               ///< the behaviour that drives it instead; "": none
    std::string script_file{};        ///< where it was found
    std::string device_model{};       ///< the behaviour that stands for its devices in simulation; "": none
    std::string device_model_file{};  ///< where it was found
    std::vector<DeviceSpec> devices{};
    std::string start;     ///< the button that starts a run with the real robot; "": none, it drives at once
    std::string shutdown;  ///< the button whose long press ends the run and shuts the computer down; "": none

    /// The backend of the real robot; "": there is none.
    std::string_view backend() const { return script.empty() ? std::string_view(driver) : scripted; }
};

/// A robot model. Frame and units as in `BodySpec`.
struct RobotSpec {
    std::string model;
    std::string doc;
    double mass = 0.5;      ///< [kg]
    double friction = 1.0;  ///< coefficient between wheels and floor, in simulation
    double noise = 0;       ///< in simulation: standard deviation of measuring sensors, relative to the value
    BodySpec body;
    DriveSpec drive;
    std::vector<SensorSpec> sensors;
    std::vector<ActuatorSpec> actuators;
    std::vector<PortSpec> ports;
    HardwareSpec hardware;
    Place place;  ///< the file
};

}  // namespace nezumi
