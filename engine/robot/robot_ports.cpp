// Makes the ports in a robot's description, or returns the first error.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <type_traits>

#include "engine/robot/robot.hpp"

namespace nezumi {
namespace {

// A sensor's value as an element of type T: the nearest integer, or the name of a colour.
template <class T>
T element(double value) {
    if constexpr (std::is_same_v<T, std::string>) {
        return std::string(to_text(static_cast<FloorColor>(value)));
    } else if constexpr (std::is_same_v<T, bool>) {
        return value != 0;
    } else if constexpr (std::is_integral_v<T>) {
        const double lowest = std::numeric_limits<T>::lowest();
        const double highest = std::numeric_limits<T>::max();
        return static_cast<T>(std::round(value < lowest ? lowest : value > highest ? highest : value));
    } else {
        return static_cast<T>(value);
    }
}

template <class T>
constexpr bool can_carry = std::is_arithmetic_v<T> || std::is_same_v<T, std::string>;

// Writes sensor readings into a message of type T, directly into the published slot.
template <class T, class SensorPort>
void write_readings(const SensorPort& port, std::span<const SensorReading> readings, std::span<const double> values,
                    double rate, const Pose3D* turned) {
    const std::size_t size = port.count > 0 ? port.count : port.sensors.size();
    const auto value = [&](std::size_t i) {
        if (port.count > 0) return values[port.first + i];
        const SensorReading& reading = readings[port.sensors[i]];
        return port.physical ? reading.physical : reading.value;
    };
    T& slot = static_cast<OutPort<T>&>(*port.port).next_pending();
    if constexpr (can_carry<T>) {
        slot = element<T>(value(0));
    } else if constexpr (std::is_same_v<T, RangeData>) {
        slot.ranges.resize(size);
        for (std::size_t i = 0; i < size; ++i) slot.ranges[i] = value(i);
        slot.config.frequency = rate;
        if (turned != nullptr) slot.geometry.pose = *turned;
    } else {
        if (slot.size() != size) slot.resize(size);  // saves a call in each tick
        for (std::size_t i = 0; i < size; ++i) slot[i] = element<typename T::value_type>(value(i));
    }
}

// How a message type carries the readings of sensors.
template <class SensorPort>
struct Carrier {
    decltype(SensorPort::write) write = nullptr;  // null: it can't
    bool is_single = false;                       // one value
    bool is_text = false;                         // names of colours, no numbers
    bool is_range = false;                        // a RangeData
};

template <class SensorPort, class T>
Carrier<SensorPort> carrier_of() {
    constexpr bool range = std::is_same_v<T, RangeData>;
    if constexpr (Sequence<T>) {
        if constexpr (can_carry<typename T::value_type>)
            return {.write = write_readings<T, SensorPort>,
                    .is_text = std::is_same_v<typename T::value_type, std::string>};
    } else if constexpr (can_carry<T> || range) {
        return {.write = write_readings<T, SensorPort>,
                .is_single = !range,
                .is_text = std::is_same_v<T, std::string>,
                .is_range = range};
    }
    return {};
}

// The smaller angle [rad] from one yaw to another.
double turn(double from, double to) { return std::remainder(to - from, 2 * std::numbers::pi); }

// The constant parts of the RangeData of these sensors. Several sensors count as one scanner in their middle, so their
// yaws must have constant steps.
Expected<RangeData> describe_ranges(const RobotSpec& spec, const std::vector<std::size_t>& sensors) {
    const SensorSpec& first = spec.sensors[sensors.front()];
    RangeData range;
    range.config = {.minAngle = 0,
                    .maxAngle = 0,
                    .angularRes = first.cone,
                    .minRange = first.minimum,
                    .maxRange = first.range,
                    .rangeRes = 0,
                    .frequency = 0};
    if (first.kind == SensorSpec::Kind::scan) {
        const ScanAngles angles = angles_of(first);
        range.geometry.pose = {.position = first.at, .orientation = {.r = 0, .p = 0, .y = first.yaw}};
        range.config.minAngle = angles.first;
        range.config.maxAngle = angles.first + angles.step * (first.rays - 1);
        range.config.angularRes = angles.step;
        return range;
    }
    if (sensors.size() == 1) {
        range.geometry.pose = {.position = first.at, .orientation = {.r = 0, .p = 0, .y = first.yaw}};
        return range;
    }
    const double step = turn(first.yaw, spec.sensors[sensors[1]].yaw);
    Point3D& middle = range.geometry.pose.position;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const SensorSpec& sensor = spec.sensors[sensors[i]];
        const auto count = static_cast<double>(sensors.size());
        middle.x += sensor.at.x / count;
        middle.y += sensor.at.y / count;
        middle.z += sensor.at.z / count;
        range.config.minRange = std::min(range.config.minRange, sensor.minimum);
        range.config.maxRange = std::max(range.config.maxRange, sensor.range);
        constexpr double even = 1e-6;  // [rad]
        if (i > 0 && (step <= 0 || std::abs(turn(spec.sensors[sensors[i - 1]].yaw, sensor.yaw) - step) > even)) {
            return failure(
                fmt::format("a RangeData gives its angles as the first, the last and a constant step from right to "
                            "left: the yaw of '{}' does not fit",
                            sensor.name));
        }
        if (sensor.on != first.on)
            return failure(fmt::format("'{}' and '{}' are not on the same part of the robot", first.name, sensor.name));
    }
    range.config.minAngle = std::remainder(first.yaw, 2 * std::numbers::pi);
    range.config.maxAngle = range.config.minAngle + step * static_cast<double>(sensors.size() - 1);
    range.config.angularRes = step;
    return range;
}

// The number of values of a sensor; 0 for a single value.
std::size_t values_of(const SensorSpec& sensor) {
    switch (sensor.kind) {
        case SensorSpec::Kind::scan: return static_cast<std::size_t>(sensor.rays);
        case SensorSpec::Kind::imu: return 6;
        default: return 0;
    }
}

// The error if a sensor does not measure this quantity, or "".
std::string_view lacks(const SensorSpec& sensor, PortSpec::Quantity quantity) {
    using Kind = SensorSpec::Kind;
    switch (quantity) {
        case PortSpec::Quantity::value: return "";
        case PortSpec::Quantity::distance:
            return sensor.kind == Kind::range || sensor.kind == Kind::scan
                       ? ""
                       : "is not a range sensor: it has no distance";
        case PortSpec::Quantity::rate:
            return sensor.kind == Kind::gyro || sensor.kind == Kind::imu ? "" : "is not a gyro: it has no rate";
        case PortSpec::Quantity::acceleration:
            return sensor.kind == Kind::imu ? "" : "is not an imu: it has no acceleration";
    }
    return "";
}

// The index of a sensor of the robot, or an error that names the nearest.
Expected<std::size_t> find_sensor(const RobotSpec& spec, std::string_view name) {
    const auto found = std::find_if(spec.sensors.begin(), spec.sensors.end(),
                                    [name](const SensorSpec& sensor) { return sensor.name == name; });
    if (found != spec.sensors.end()) return static_cast<std::size_t>(found - spec.sensors.begin());
    std::vector<std::string_view> names{"velocity", "odometry", "stalled"};
    for (const SensorSpec& sensor : spec.sensors) names.push_back(sensor.name);
    return failure(fmt::format("there is no sensor '{}'{}", shown(name), did_you_mean(name, names)));
}

}  // namespace

Expected<void> Robot::add_port(const PortSpec& port) {
    if (find_port(port.name) != nullptr) return failure("is declared twice");
    if (port.items.empty()) return failure("has no `from` and no `to`");
    return port.is_input ? add_input(port) : add_output(port);
}

Expected<void> Robot::add_output(const PortSpec& port) {
    const auto type = find_message_type(port.type);
    if (!type) return Unexpected(type.error());
    const std::string& item = port.items.front();
    if (item == "stalled") {
        if (port.type != "TimedBoolean")
            return failure(fmt::format("'stalled' is a TimedBoolean, not a {}", port.type));
        if (stalled_out_ != nullptr) return failure("a robot can have only one out-port of 'stalled'");
        stalled_out_ = &add_out_port<bool>(port.name, port.doc);
        return {};
    }
    if (item == "velocity" || item == "odometry") {
        const std::string_view expected = item == "velocity" ? "TimedVelocity2D" : "TimedPose2D";
        if (port.type != expected) return failure(fmt::format("'{}' is a {}, not a {}", item, expected, port.type));
        if (item == "velocity") {
            auto& made = add_out_port<Velocity2D>(port.name, port.doc);
            made.set_safe(std::nullopt);  // a measurement, no command
            made.set_rate(port.rate);
            velocity_ports_.push_back({&made, port.rate});
        } else {
            auto& made = add_out_port<Pose2D>(port.name, port.doc);
            made.set_rate(port.rate);
            pose_ports_.push_back({&made, port.rate});
        }
        return {};
    }
    std::vector<std::size_t> sensors;
    for (const std::string& name : port.items) {
        const auto sensor = find_sensor(spec_, name);
        if (!sensor) return Unexpected(sensor.error());
        sensors.push_back(*sensor);
    }
    const auto sees_robots = [&](std::size_t i) { return spec_.sensors[i].kind == SensorSpec::Kind::neighbours; };
    if (port.type == "NeighbourSeq" || std::any_of(sensors.begin(), sensors.end(), sees_robots))
        return add_neighbours(port, sensors);
    const auto carrier = with_payload_type(**type, []<class T>() { return carrier_of<SensorPort, T>(); });
    if (carrier.write == nullptr) return failure(fmt::format("a {} can't carry sensors' values", port.type));
    if (carrier.is_single && sensors.size() > 1)
        return failure(fmt::format("a {} carries the value of one sensor, not of {}", port.type, sensors.size()));
    for (const std::size_t i : sensors) {
        const SensorSpec& sensor = spec_.sensors[i];
        if (carrier.is_text && sensor.kind != SensorSpec::Kind::color)
            return failure(fmt::format("a {} carries colours, and '{}' is not a color sensor", port.type, sensor.name));
        const std::string_view lack = lacks(sensor, carrier.is_range ? PortSpec::Quantity::distance : port.quantity);
        if (!lack.empty()) return failure(fmt::format("'{}' {}", sensor.name, lack));
        if (values_of(sensor) == 0) continue;
        if (sensors.size() > 1)
            return failure(fmt::format("'{}' has several values: it needs its own port", sensor.name));
        if (carrier.is_single || carrier.is_text)
            return failure(fmt::format("'{}' has several values, and a {} carries one", sensor.name, port.type));
    }
    const bool is_acceleration = port.quantity == PortSpec::Quantity::acceleration;
    const bool is_half = is_acceleration || port.quantity == PortSpec::Quantity::rate;
    const std::size_t count = values_of(spec_.sensors[sensors.front()]);
    SensorPort made{.port = nullptr,
                    .write = carrier.write,
                    .sensors = sensors,
                    .first = is_acceleration ? count / 2 : 0,
                    .count = is_half ? count / 2 : count,
                    .physical = port.quantity != PortSpec::Quantity::value || carrier.is_range,
                    .rate = port.rate,
                    .pose = {},
                    .servo = std::nullopt};
    auto out = make_out_port(*type, port.name, port.doc);
    if (carrier.is_range) {
        const auto range = describe_ranges(spec_, sensors);
        if (!range) return Unexpected(range.error());
        static_cast<OutPort<RangeData>&>(*out).prepare(*range);
        made.pose = range->geometry.pose;
        for (std::size_t i = 0; i < spec_.actuators.size(); ++i) {
            const ActuatorSpec& actuator = spec_.actuators[i];
            if (actuator.kind == ActuatorSpec::Kind::servo && actuator.name == spec_.sensors[sensors.front()].on)
                made.servo = i;
        }
    }
    made.port = out.get();
    made.port->set_rate(port.rate);
    out_ports_.push_back(std::move(out));
    sensor_ports_.push_back(std::move(made));
    return {};
}

Expected<void> Robot::add_input(const PortSpec& port) {
    if (port.items.size() != 1) return failure("'to' must name exactly one target");
    const std::string& item = port.items.front();
    const auto is_type = [&](std::string_view type) -> Expected<void> {
        if (port.type == type) return {};
        return failure(fmt::format("'{}' takes a {}, not a {}", item, type, port.type));
    };
    if (item == "drive") {
        if (auto ok = is_type("TimedVelocity2D"); !ok) return ok;
        if (velocity_in_ != nullptr) return failure("a robot can have only one in-port for its drive");
        velocity_in_ = &add_in_port<Velocity2D>(port.name, port.doc, port.queue);
        return {};
    }
    if (item == "odometry") {
        if (auto ok = is_type("TimedPose2D"); !ok) return ok;
        if (pose_in_ != nullptr) return failure("a robot can have only one in-port for its odometry");
        pose_in_ = &add_in_port<Pose2D>(port.name, port.doc, port.queue);
        return {};
    }
    if (item == "say") {
        if (auto ok = is_type("TimedDoubleSeq"); !ok) return ok;
        if (say_in_ != nullptr) return failure("a robot can have only one in-port for what it says");
        say_in_ = &add_in_port<std::vector<double>>(port.name, port.doc, port.queue);
        is_quiet_when_silent_ = port.off_when_silent;
        return {};
    }
    std::vector<std::string_view> names{"drive", "odometry", "say"};
    for (std::size_t i = 0; i < spec_.actuators.size(); ++i) {
        const ActuatorSpec& actuator = spec_.actuators[i];
        names.push_back(actuator.name);
        if (actuator.name != item) continue;
        const std::string_view type = Actuators::type_for(actuator.kind);
        if (auto ok = is_type(type); !ok) return ok;
        in_ports_.push_back(make_in_port(*find_message_type(type), port.name, port.doc, port.queue));
        return actuators_.add(i, *in_ports_.back(), port.off_when_silent);
    }
    return failure(fmt::format("there is no actuator '{}'{}", shown(item), did_you_mean(item, names)));
}

}  // namespace nezumi
