// Body, drive, sensors, actuators and ports of a robot file, each field checked.
#include "bindings/lua/files/robot_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bindings/lua/values/member_names.hpp"
#include "engine/base/names.hpp"
#include "engine/robot/robot.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {
namespace {

constexpr double clearance = 0.01;     // [m] between the floor and a hull whose height nobody gave
constexpr double least_length = 1e-3;  // [m] of a hull or between wheels: smaller robots can't be simulated
constexpr double least_mass = 1e-3;    // [kg]

// A number that a simulated robot can't do with less of.
bool read_at_least(Fields& fields, std::string_view name, double& out, double least, std::string_view unit) {
    if (!fields.number(name, out, NumberRange::positive)) return false;
    if (out < least)
        fields.check().wrong(fields.path_of(name), fmt::format("expected at least {} {}, got {}", least, unit, out));
    return true;
}

// A text or a list of texts.
std::vector<std::string> read_names(Fields& fields, std::string_view name) {
    const FileValue* value = fields.field(name);
    if (value == nullptr) return {};
    if (const std::string* text = value->text()) return {*text};
    std::vector<std::string> names;
    const FileTable* table = value->table();
    bool fits = table != nullptr && table->fields.empty() && !table->elements.empty();
    for (std::size_t i = 0; fits && i < table->elements.size(); ++i) {
        const std::string* text = table->elements[i].text();
        fits = text != nullptr;
        if (fits) names.push_back(*text);
    }
    if (!fits)
        fields.check().wrong(fields.path_of(name), fmt::format("expected a name or a list of names, got {}",
                                                               table == nullptr ? kind_of(*value) : "another table"));
    return names;
}

// Calls `read(name, fields)` for each entry of a table of named tables.
template <class Read>
void for_each_named(Fields& fields, std::string_view group, Read&& read) {
    Fields named = fields.inner(group);
    for (const auto& [name, value] : named.all()) {
        named.field(name);
        if (!is_identifier(name) && !is_keyword(name)) {
            fields.check().wrong_at(named.path_of(name),
                                    fmt::format("{}: '{}' is no name: expected letters, digits and _", group, name));
            continue;
        }
        Fields entry(fields.check(), value, named.path_of(name));
        read(name, entry);
        entry.done();
    }
    named.done([](std::string_view) -> std::string { return ": expected NAME = { ... }"; });
}

// A hull that nobody described: a box about as long and as wide as the wheels are apart.
BodySpec body_over(double track) {
    BodySpec spec;
    spec.size = {1.1 * track, 0.9 * track, 0.65 * track};
    spec.at = {0, 0, clearance + spec.size.z / 2};
    return spec;
}

BodySpec read_body(Fields body) {
    BodySpec spec;
    std::size_t shape = 0;
    body.choice("shape", shape, {"box", "cylinder"});
    spec.shape = shape == 0 ? BodySpec::Shape::box : BodySpec::Shape::cylinder;
    double radius = 0;
    double height = 0;
    if (spec.shape == BodySpec::Shape::cylinder && (body.has("radius") || body.has("height"))) {
        if (read_at_least(body, "radius", radius, least_length, "m") &&
            read_at_least(body, "height", height, least_length, "m")) {
            spec.size = {2 * radius, 2 * radius, height};
        }
        body.require("radius", "metres");
        body.require("height", "metres");
    } else {
        body.require("size", "{ length, width, height } in metres");
        if (body.point("size", spec.size, NumberRange::positive) &&
            std::min({spec.size.x, spec.size.y, spec.size.z}) < least_length) {
            body.check().wrong(body.path_of("size"), fmt::format("expected lengths of at least {} m", least_length));
        }
    }
    if (spec.shape == BodySpec::Shape::cylinder && spec.size.x != spec.size.y) {
        body.check().wrong(body.path_of("size"), "expected { diameter, diameter, height } of a cylinder");
    }
    spec.at = {0, 0, clearance + spec.size.z / 2};
    body.point("at", spec.at, NumberRange::any, true);
    body.done();
    return spec;
}

DriveSpec read_drive(Fields drive) {
    DriveSpec spec;
    drive.require("radius", "the wheels' radius in metres");
    drive.require("track", "the distance between the wheels in metres");
    read_at_least(drive, "radius", spec.radius, least_length, "m");
    read_at_least(drive, "track", spec.track, least_length, "m");
    drive.number("pulses_per_turn", spec.pulses_per_turn, NumberRange::not_negative);
    spec.skid = 0;
    drive.number("skid", spec.skid, NumberRange::positive);
    drive.boolean("coasts_until_commanded", spec.coasts_until_commanded);
    read_limits(drive.inner("limits"), spec.limits);
    spec.hardware_limits = spec.limits;
    read_limits(drive.inner("hardware_limits"), spec.hardware_limits);
    drive.done();
    return spec;
}

ActuatorSpec read_actuator(const std::string& name, Fields& actuator, const BodySpec& body) {
    using Kind = ActuatorSpec::Kind;
    ActuatorSpec spec;
    spec.name = name;
    std::size_t kind = 0;
    const std::vector<std::string_view> kinds{"leds", "buzzer", "servo", "screen", "speaker"};
    actuator.require("kind", fmt::format("one of {}", fmt::join(kinds, ", ")));
    actuator.choice("kind", kind, kinds);
    spec.kind = static_cast<Kind>(kind);
    if (spec.kind == Kind::leds) {
        std::int64_t count = spec.count;
        actuator.whole("count", count, 1, 1000);
        spec.count = static_cast<int>(count);
    }
    if (spec.kind == Kind::servo) {
        actuator.number("max_rate", spec.max_rate, NumberRange::not_negative);
        actuator.number("minimum", spec.minimum);
        actuator.number("maximum", spec.maximum);
        if (spec.minimum > spec.maximum)
            actuator.check().explain(actuator.path_of("minimum"),
                                     fmt::format("{} is above maximum {}", spec.minimum, spec.maximum));
        Point3D at{};
        actuator.point("at", at, NumberRange::any, true);
        spec.at = {body.at.x + at.x, body.at.y + at.y, body.at.z + at.z};
    }
    return spec;
}

PortSpec read_port(const std::string& name, Fields& port) {
    PortSpec spec;
    spec.name = name;
    port.require("type", "a message type");
    port.text("type", spec.type);
    const bool from = port.has("from");
    spec.is_input = port.has("to");
    if (from == spec.is_input)
        port.check().wrong_at(
            port.path(),
            fmt::format("port '{}': expected either 'from', what an out-port carries, or 'to', what an in-port drives",
                        name));
    spec.items = read_names(port, spec.is_input ? "to" : "from");
    port.text("doc", spec.doc);
    if (spec.is_input) {
        std::int64_t queue = 0;
        port.whole("queue", queue, 0, 1000);
        spec.queue = static_cast<std::size_t>(queue);
        std::size_t silence = 0;
        port.choice("silence", silence, {"hold", "off"});
        spec.off_when_silent = silence == 1;
    } else {
        port.number("rate", spec.rate, NumberRange::not_negative);
        std::size_t quantity = 0;
        port.choice("quantity", quantity, {"value", "distance"});
        spec.quantity = static_cast<PortSpec::Quantity>(quantity);
    }
    return spec;
}

// What every robot on wheels has: ports that the file gives no others for.
void add_wheel_ports(RobotSpec& spec) {
    const auto add = [&](bool is_input, std::string_view item, const char* name, const char* type, const char* doc) {
        const bool has = std::any_of(spec.ports.begin(), spec.ports.end(), [&](const PortSpec& port) {
            return port.name == name ||
                   (port.is_input == is_input && !port.items.empty() && port.items.front() == item);
        });
        if (has) return;
        PortSpec port;
        port.name = name;
        port.is_input = is_input;
        port.type = type;
        port.items = {std::string(item)};
        port.doc = doc;
        spec.ports.push_back(std::move(port));
    };
    add(true, "drive", "target_velocity_in", "TimedVelocity2D", "target velocity");
    add(true, "odometry", "pose_update", "TimedPose2D", "sets the odometry's pose");
    add(false, "velocity", "current_velocity_out", "TimedVelocity2D",
        "velocity measured at the wheels, in the robot's frame");
    add(false, "odometry", "current_pose_out", "TimedPose2D", "odometry pose");
}

void check_carriers(FieldCheck& check, const RobotSpec& spec) {
    std::vector<std::string_view> servos;
    for (const ActuatorSpec& actuator : spec.actuators) {
        if (actuator.kind == ActuatorSpec::Kind::servo) servos.push_back(actuator.name);
    }
    for (const SensorSpec& sensor : spec.sensors) {
        if (sensor.on.empty() || std::find(servos.begin(), servos.end(), sensor.on) != servos.end()) continue;
        check.wrong({"sensors", sensor.name, "on"},
                    fmt::format("expected a servo, there is none '{}'{}", sensor.on, did_you_mean(sensor.on, servos)));
    }
}

// The robot itself knows which type carries what: it is asked port by port, so that each error has the port's place.
void check_ports(FieldCheck& check, const RobotSpec& spec) {
    RobotSpec one = spec;
    for (SensorSpec& sensor : one.sensors) sensor.response = {};
    for (const PortSpec& port : spec.ports) {
        one.ports = {port};
        if (auto robot = Robot::make("check", one, {}, 0, 0); !robot)
            check.wrong_at({"ports", port.name}, robot.error().message);
    }
    one.ports = spec.ports;
    if (auto robot = Robot::make("check", one, {}, 0, 0); !robot) check.wrong_at({"ports"}, robot.error().message);
}

}  // namespace

void read_limits(Fields fields, Limits& limits) {
    fields.number("speed", limits.speed, NumberRange::positive);
    fields.number("yaw_rate", limits.yaw_rate, NumberRange::positive);
    fields.number("acceleration", limits.acceleration, NumberRange::positive);
    fields.number("yaw_acceleration", limits.yaw_acceleration, NumberRange::positive);
    fields.done();
}

RobotSpec read_robot_fields(FieldCheck& check, const FileValue& value, const RobotFileHelp& help) {
    RobotSpec spec;
    Fields fields(check, value);
    fields.text("doc", spec.doc);
    fields.require("mass", "kilograms");
    read_at_least(fields, "mass", spec.mass, least_mass, "kg");
    fields.require("drive", "{ radius =, track =, limits = }");
    if (fields.has("drive")) spec.drive = read_drive(fields.inner("drive"));
    spec.body = fields.has("body") ? read_body(fields.inner("body")) : body_over(spec.drive.track);
    if (spec.drive.skid == 0) spec.drive.skid = 0.4 * spec.body.size.x;
    for_each_named(fields, "sensors", [&](const std::string& name, Fields& entry) {
        spec.sensors.push_back(read_sensor_fields(name, entry, spec.body, help));
    });
    for_each_named(fields, "actuators", [&](const std::string& name, Fields& entry) {
        spec.actuators.push_back(read_actuator(name, entry, spec.body));
    });
    for_each_named(fields, "ports", [&](const std::string& name, Fields& entry) {
        const auto& words = robot_words();
        if (std::find(words.begin(), words.end(), name) != words.end()) {
            check.wrong_at(entry.path(),
                           fmt::format("port '{0}': the name is taken: robot.{0} is a component's own word", name));
        }
        spec.ports.push_back(read_port(name, entry));
    });
    fields.done();
    add_wheel_ports(spec);
    if (check.ok()) check_carriers(check, spec);
    if (check.ok()) check_ports(check, spec);
    return spec;
}

}  // namespace nezumi
