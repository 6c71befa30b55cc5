// The tables of a robot file: every field with unit, documentation and limits.
#pragma once

#include "engine/ports/setting.hpp"
#include "engine/world/robot_spec.hpp"

namespace nezumi {

inline constexpr double least_robot_length = 1e-3;  ///< [m] of a hull or between wheels; less can't be simulated
inline constexpr double least_robot_mass = 1e-3;    ///< [kg]
inline constexpr double hull_clearance = 0.01;      ///< [m] below a hull without a given height

/// The rule of a limit. If `S` changes the limits of a model, an omitted limit is the model's.
template <class S>
inline constexpr Rule limit_rule{
    .range = NumberRange::positive,
    .fallback = std::is_same_v<decltype(S::speed), double> ? std::string_view() : "as of the model"};

/// The four limits of `S`, a structure with these members.
template <class S>
inline constexpr FieldList limit_fields{
    Setting{"speed", &S::speed, "m/s", "along x, both ways", limit_rule<S>},
    Setting{"yaw_rate", &S::yaw_rate, "rad/s", "both ways", limit_rule<S>},
    Setting{"acceleration", &S::acceleration, "m/s^2", "along x; also when braking", limit_rule<S>},
    Setting{"yaw_acceleration", &S::yaw_acceleration, "rad/s^2", "of the yaw rate", limit_rule<S>},
};

template <>
struct Describe<Limits> {
    static constexpr std::string_view name = "limits";
    static constexpr std::string_view doc = "Limits of a robot's velocity commands.";
    static constexpr auto& fields = limit_fields<Limits>;
};

template <>
struct Choices<BodySpec::Shape> {
    static constexpr std::array<std::string_view, 2> names{"box", "cylinder"};
};

template <>
struct Describe<BodySpec> {
    static constexpr std::string_view name = "body";
    static constexpr std::string_view doc = "The robot's hull. Without it: a box about as large as the track.";
    static constexpr auto& kinds = Choices<BodySpec::Shape>::names;
    static constexpr FieldList fields{
        Setting{"shape", &BodySpec::shape, "", "", {.selects = true}},
        Setting{"size",
                &BodySpec::size,
                "m",
                "length, width, height; of a cylinder: diameter, diameter, height",
                {.range = NumberRange::positive, .least = least_robot_length, .by_hand = true, .fallback = "required"}},
        Extra{"radius", "number", "m", "instead of `size`", {.of = 1U << 1U, .fallback = "that of `size`"}},
        Extra{"height", "number", "m", "instead of `size`", {.of = 1U << 1U, .fallback = "that of `size`"}},
        Setting{"at",
                &BodySpec::at,
                "m",
                "centre of the hull; x, y from the middle of the wheels' axis, z from the floor",
                {.level = true, .fallback = "1 cm over the floor"}},
    };
};

template <>
struct Describe<DriveSpec> {
    static constexpr std::string_view name = "drive";
    static constexpr std::string_view doc = "Two driven wheels on one axis, and skids before and behind.";
    static constexpr FieldList fields{
        Setting{"radius",
                &DriveSpec::radius,
                "m",
                "of the wheels",
                {.required = true, .range = NumberRange::positive, .least = least_robot_length}},
        Setting{"left_radius",
                &DriveSpec::left_radius,
                "m",
                "of the left wheel, if it is known to differ",
                {.range = NumberRange::positive, .least = least_robot_length, .fallback = "`radius`"}},
        Setting{"right_radius",
                &DriveSpec::right_radius,
                "m",
                "of the right wheel, if it is known to differ",
                {.range = NumberRange::positive, .least = least_robot_length, .fallback = "`radius`"}},
        Setting{"track",
                &DriveSpec::track,
                "m",
                "between the wheels",
                {.required = true, .range = NumberRange::positive, .least = least_robot_length}},
        Setting{"pulses_per_turn",
                &DriveSpec::pulses_per_turn,
                "",
                "encoder pulses per turn of a wheel; 0: continuous",
                {.range = NumberRange::not_negative}},
        Setting{"skid",
                &DriveSpec::skid,
                "m",
                "distance of the skids from the axis",
                {.range = NumberRange::positive, .fallback = "0.4 of the hull's length"}},
        Setting{"coasts_until_commanded", &DriveSpec::coasts_until_commanded, "",
                "the wheels roll freely until the first command after activation"},
        Setting{"limits", &DriveSpec::limits, "", "each can be set again per robot in the system file"},
        Setting{"hardware_limits",
                &DriveSpec::hardware_limits,
                "",
                "limits on the real robot, until its odometry is calibrated",
                {.fallback = "`limits`"}},
        Setting{"needs", &DriveSpec::needs, "",
                "sensors that it needs to drive: it stops if one of them gave no value for 0.3 s"},
        Setting{"port",
                &DriveSpec::port,
                "",
                "devices of the real robot's left and right motor",
                {.fallback = "the driver's own"}},
    };
};

template <>
struct Choices<SensorSpec::Kind> {
    static constexpr std::array<std::string_view, 10> names{"range",   "button",  "touch", "gyro", "color",
                                                            "reflect", "ambient", "scan",  "imu",  "neighbours"};
};

template <>
struct Describe<SensorSpec> {
    static constexpr std::string_view name = "sensor";
    static constexpr std::string_view doc =
        "A sensor: a distance, a button, a bumper, a yaw angle, the floor's colour, light from the floor or of the "
        "room, a scan of distances, rates and accelerations, the robots around.";
    static constexpr auto& kinds = Choices<SensorSpec::Kind>::names;
    static constexpr unsigned range_only = 1U << 0U, touch_only = 1U << 2U, gyro_only = 1U << 3U,
                              reflect_only = 1U << 5U, ambient_only = 1U << 6U, scan_only = 1U << 7U,
                              imu_only = 1U << 8U, neighbours_only = 1U << 9U, ranging = range_only | scan_only;
    static constexpr FieldList fields{
        Setting{"kind", &SensorSpec::kind, "", "what it measures", {.required = true, .selects = true}},
        Setting{"at", &SensorSpec::at, "m", "from the hull's centre", {.level = true}},
        Setting{"yaw", &SensorSpec::yaw, "rad", "where it looks, counter-clockwise"},
        Setting{"on", &SensorSpec::on, "", "the servo that carries it, instead of the hull"},
        Setting{"range",
                &SensorSpec::range,
                "m",
                "largest distance that it sees",
                {.range = NumberRange::positive, .of = ranging}},
        Setting{"minimum",
                &SensorSpec::minimum,
                "m",
                "smallest distance that it sees",
                {.range = NumberRange::not_negative, .of = ranging}},
        Setting{"cone",
                &SensorSpec::cone,
                "rad",
                "full opening angle, 0: a single ray; of a scan, its field of view",
                {.range = NumberRange::not_negative, .of = ranging, .fallback = "0; for a scan a full turn"}},
        Setting{"rays",
                &SensorSpec::rays,
                "",
                "rays in the cone: the nearest hit counts; a scan gives the distance of each, from right to left",
                {.min = 1, .max = 1000, .of = ranging, .fallback = "5 with a `cone`, else 1; for a scan 360"}},
        Setting{"noise",
                &SensorSpec::noise,
                "",
                "standard deviation, in the value's unit; of an imu, of its rates in rad/s; of neighbours, of their "
                "ranges in m",
                {.range = NumberRange::not_negative,
                 .of = range_only | gyro_only | reflect_only | ambient_only | scan_only | imu_only | neighbours_only}},
        Setting{"acceleration_noise",
                &SensorSpec::acceleration_noise,
                "m/s^2",
                "standard deviation of its accelerations",
                {.range = NumberRange::not_negative, .of = imu_only}},
        Extra{
            "table",
            "string|number[][]",
            "",
            "a CSV file with the columns `distance_m` and `value` beside the robot file, or points `{ { 0.01, 1394 }, "
            "... }`. Exact at its points; nearer than the first the value goes on as a power law, farther than the "
            "last it fades to `nothing` at `range`",
            {.of = range_only}},
        Extra{
            "response",
            "fun(distance: number): number",
            "",
            "instead of `table`: it is sampled when the file is read; `response(math.huge)` is the value with nothing "
            "in sight",
            {.of = range_only}},
        Extra{"nothing", "number", "", "the value with nothing in sight", {.of = range_only, .fallback = "0"}},
        Extra{
            "min_value", "number", "", "lower bound of the value", {.of = range_only, .fallback = "0 with a `table`"}},
        Extra{"max_value",
              "number",
              "",
              "upper bound of the value",
              {.of = range_only, .fallback = "4095 with a `table`"}},
        Setting{"drift", &SensorSpec::drift, "rad/s", "", {.of = gyro_only}},
        Setting{"max_rate",
                &SensorSpec::max_rate,
                "rad/s",
                "largest rate that it measures; 0: no limit",
                {.range = NumberRange::not_negative, .of = gyro_only | imu_only}},
        Setting{"travel",
                &SensorSpec::travel,
                "m",
                "way that it is pushed in until it closes",
                {.range = NumberRange::not_negative, .of = touch_only}},
        Setting{"level",
                &SensorSpec::level,
                "",
                "light of the simulated room, from 0 (dark) to 100",
                {.range = NumberRange::not_negative, .of = ambient_only}},
        Setting{"radius",
                &SensorSpec::radius,
                "m",
                "largest distance at which it sees robots",
                {.range = NumberRange::positive, .of = neighbours_only}},
        Setting{"bearing_noise",
                &SensorSpec::bearing_noise,
                "rad",
                "standard deviation of its bearings",
                {.range = NumberRange::not_negative, .of = neighbours_only}},
        Setting{"loss",
                &SensorSpec::loss,
                "",
                "probability that it misses a robot, each time",
                {.range = NumberRange::not_negative, .most = 1, .of = neighbours_only}},
        Setting{"port",
                &SensorSpec::port,
                "",
                "which device of the real robot it is",
                {.fallback = "the driver's own choice"}},
        Internal{&SensorSpec::name},
        Internal{&SensorSpec::response},
        Internal{&SensorSpec::has_response},
    };
};

template <>
struct Choices<ActuatorSpec::Kind> {
    static constexpr std::array<std::string_view, 5> names{"leds", "buzzer", "servo", "screen", "speaker"};
};

template <>
struct Describe<ActuatorSpec> {
    static constexpr std::string_view name = "actuator";
    static constexpr std::string_view doc =
        "An actuator in addition to the wheels. A screen takes a CameraImage; a speaker a TimedString: `beep`, "
        "`tone,HZ,MS` or "
        "a text to speak.";
    static constexpr auto& kinds = Choices<ActuatorSpec::Kind>::names;
    static constexpr unsigned leds_only = 1U << 0U, servo_only = 1U << 2U;
    static constexpr FieldList fields{
        Setting{"kind", &ActuatorSpec::kind, "", "", {.required = true, .selects = true}},
        Setting{"count", &ActuatorSpec::count, "", "number of lights", {.min = 1, .max = 1000, .of = leds_only}},
        Setting{"max_rate",
                &ActuatorSpec::max_rate,
                "rad/s",
                "largest speed; 0: no limit",
                {.range = NumberRange::not_negative, .of = servo_only}},
        Setting{"speed",
                &ActuatorSpec::speed,
                "rad/s",
                "initial speed, the default of the robot's parameter `NAME_speed`. 0: as fast as possible, without "
                "this parameter",
                {.range = NumberRange::not_negative, .of = servo_only}},
        Setting{"minimum", &ActuatorSpec::minimum, "rad", "", {.of = servo_only}},
        Setting{"maximum", &ActuatorSpec::maximum, "rad", "equal to `minimum`: unlimited", {.of = servo_only}},
        Setting{"at", &ActuatorSpec::at, "m", "its axis, from the hull's centre", {.level = true, .of = servo_only}},
        Setting{"port",
                &ActuatorSpec::port,
                "",
                "which device of the real robot it is",
                {.fallback = "the driver's own choice"}},
        Internal{&ActuatorSpec::name},
    };
};

template <>
struct Choices<PortSpec::Quantity> {
    static constexpr std::array<std::string_view, 4> names{"value", "distance", "rate", "acceleration"};
};

template <>
struct Describe<PortSpec> {
    static constexpr std::string_view name = "port";
    static constexpr std::string_view doc = "A port of the robot, with its sensors or its actuator.";
    static constexpr std::array<std::string_view, 2> kinds{"out-port", "in-port"};
    static constexpr unsigned out_only = 1U << 0U, in_only = 1U << 1U;
    static constexpr FieldList fields{
        Setting{"type", &PortSpec::type, "", "a message type", {.required = true}},
        Setting{"from",
                &PortSpec::items,
                "",
                "a sensor, a list of them, `\"velocity\"` (measured at the wheels), `\"odometry\"` or `\"stalled\"` "
                "(whether a wheel is blocked)",
                {.of = out_only, .fallback = "required"}},
        Setting{"to",
                &PortSpec::items,
                "",
                "`\"drive\"`, `\"odometry\"` (sets it), `\"say\"` (at most 10 numbers, which `neighbours` of others "
                "see) or "
                "an actuator",
                {.of = in_only, .fallback = "required"}},
        Setting{"doc", &PortSpec::doc, "", "documentation for editors and the console"},
        Setting{"rate",
                &PortSpec::rate,
                "Hz",
                "messages per second; 0: one each tick",
                {.range = NumberRange::not_negative, .of = out_only}},
        Setting{"quantity",
                &PortSpec::quantity,
                "",
                "`\"distance\"`: metres instead of a range sensor's value; `\"rate\"`: of a gyro instead of its angle, "
                "of an "
                "imu its three rates; `\"acceleration\"`: of an imu its three accelerations",
                {.of = out_only}},
        Setting{"queue",
                &PortSpec::queue,
                "",
                "how many unread messages are kept; 0: the latest",
                {.max = 1000, .of = in_only}},
        Setting{"silence",
                &PortSpec::off_when_silent,
                "",
                "after 0.5 s without a message: the actuator holds or goes off",
                {.words = {"hold", "off"}, .of = in_only}},
        Internal{&PortSpec::name},
        Internal{&PortSpec::is_input},
    };
};

template <>
struct Describe<HardwareSpec> {
    static constexpr std::string_view name = "hardware";
    static constexpr std::string_view doc = "How `nezumi run --hw` reaches the real robot.";
    static constexpr FieldList fields{
        Setting{"driver",
                &HardwareSpec::driver,
                "",
                "\"raspimouse\" or \"ev3\"",
                {.fallback = "required without `script`"}},
        Setting{"script",
                &HardwareSpec::script,
                "",
                "instead of `driver`: a behaviour that drives the robot through its devices",
                {.fallback = "none"}},
        Extra{"devices",
              "table<string, Device>",
              "",
              "of a `script`, by name: `{ line = serial { ... } }`",
              {.by_hand = true, .fallback = "none"}},
        Setting{
            "device_model",
            &HardwareSpec::device_model,
            "",
            "with `script`: a behaviour that stands for the devices in simulation, so that the driver runs there too",
            {.fallback = "the simulated robot has no driver"}},
        Setting{"start",
                &HardwareSpec::start,
                "",
                "a sensor of kind `button`: the run waits until it is pressed",
                {.fallback = "the run starts at once"}},
        Setting{"shutdown",
                &HardwareSpec::shutdown,
                "",
                "a sensor of kind `button`: held for 3 s it ends the run and shuts the robot's computer down",
                {.fallback = "none does"}},
        Internal{&HardwareSpec::script_file},
        Internal{&HardwareSpec::device_model_file},
        Internal{&HardwareSpec::devices},
    };
};

template <>
struct Describe<RobotSpec> {
    static constexpr std::string_view name = "robot_model";
    static constexpr std::string_view doc = "A model of robot: `return robot_model { ... }` is a robot file.";
    static constexpr FieldList fields{
        Extra{"base",
              "string",
              "",
              "a robot file that this one builds on: omitted fields are those of the base. Tables with names are "
              "merged, lists "
              "and positions are replaced as a whole, `false` removes an entry",
              {.by_hand = true}},
        Setting{"doc", &RobotSpec::doc, "", "what it is"},
        Setting{"mass",
                &RobotSpec::mass,
                "kg",
                "of the whole robot",
                {.required = true, .range = NumberRange::positive, .least = least_robot_mass}},
        Setting{"friction",
                &RobotSpec::friction,
                "",
                "friction of the simulated wheels on the floor: 1 is rubber, 0.1 is ice",
                {.range = NumberRange::not_negative}},
        Setting{"noise",
                &RobotSpec::noise,
                "",
                "in simulation: standard deviation of each sensor that measures, relative to its value (0.05: 5 %), in "
                "addition to the sensor's own `noise`",
                {.range = NumberRange::not_negative, .most = 1}},
        Setting{"drive", &RobotSpec::drive, "", "wheels, skids and limits", {.required = true, .by_hand = true}},
        Setting{"body",
                &RobotSpec::body,
                "",
                "the hull",
                {.by_hand = true, .fallback = "a box about as large as the track"}},
        Setting{"sensors", &RobotSpec::sensors, "", "by name", {.by_hand = true}},
        Setting{"actuators", &RobotSpec::actuators, "", "by name", {.by_hand = true}},
        Setting{"ports", &RobotSpec::ports, "", "by name", {.by_hand = true}},
        Setting{"hardware",
                &RobotSpec::hardware,
                "",
                "the real robot's driver",
                {.by_hand = true, .fallback = "only simulated"}},
        Internal{&RobotSpec::model},
        Internal{&RobotSpec::place},
    };
};

}  // namespace nezumi
