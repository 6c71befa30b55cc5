// Body, drive, sensors, actuators and ports of a robot file, each field checked.
#include "bindings/lua/robot_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/robot.hpp"
#include "engine/system_spec.hpp"

namespace nezumi {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double clearance = 0.01;    // [m] between the floor and a hull whose height nobody gave
constexpr double twelve_bits = 4095;  // the largest value of a table, unless it says otherwise

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
        if (!is_identifier(name) && !is_reserved_name(name)) {
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

BodySpec read_body(Fields body) {
    BodySpec spec;
    std::size_t shape = 0;
    body.choice("shape", shape, {"box", "cylinder"});
    spec.shape = shape == 0 ? BodySpec::Shape::box : BodySpec::Shape::cylinder;
    double radius = 0;
    double height = 0;
    if (spec.shape == BodySpec::Shape::cylinder && (body.has("radius") || body.has("height"))) {
        if (body.number("radius", radius, NumberRange::positive) &&
            body.number("height", height, NumberRange::positive)) {
            spec.size = {2 * radius, 2 * radius, height};
        }
        body.require("radius", "metres");
        body.require("height", "metres");
    } else {
        body.require("size", "{ length, width, height } in metres");
        body.point("size", spec.size, NumberRange::positive);
    }
    if (spec.shape == BodySpec::Shape::cylinder && spec.size.x != spec.size.y) {
        body.check().wrong(body.path_of("size"), "expected { diameter, diameter, height } of a cylinder");
    }
    spec.at = {0, 0, clearance + spec.size.z / 2};
    body.point("at", spec.at, NumberRange::any, true);
    body.done();
    return spec;
}

DriveSpec read_drive(Fields drive, const BodySpec& body) {
    DriveSpec spec;
    drive.require("radius", "the wheels' radius in metres");
    drive.require("track", "the distance between the wheels in metres");
    drive.number("radius", spec.radius, NumberRange::positive);
    drive.number("track", spec.track, NumberRange::positive);
    drive.number("pulses_per_turn", spec.pulses_per_turn, NumberRange::not_negative);
    spec.skid = 0.4 * body.size.x;
    drive.number("skid", spec.skid, NumberRange::positive);
    drive.boolean("coasts_until_commanded", spec.coasts_until_commanded);
    read_limits(drive.inner("limits"), spec.limits);
    spec.hardware_limits = spec.limits;
    read_limits(drive.inner("hardware_limits"), spec.hardware_limits);
    drive.done();
    return spec;
}

// Inline points: `{ { 0.01, 1394 }, { 0.02, 792 } }`.
std::vector<ResponseTable::Point> read_points(Fields& sensor, const FileTable& table) {
    std::vector<ResponseTable::Point> points;
    for (const FileValue& element : table.elements) {
        double pair[2] = {0, 0};
        const FileTable* point = element.table();
        bool fits = point != nullptr && point->elements.size() == 2;
        for (std::size_t i = 0; fits && i < 2; ++i) {
            const FileValue& number = point->elements[i];
            if (const auto* whole = std::get_if<std::int64_t>(&number.data)) {
                pair[i] = static_cast<double>(*whole);
            } else if (const auto* real = std::get_if<double>(&number.data)) {
                pair[i] = *real;
            } else {
                fits = false;
            }
        }
        if (!fits) {
            sensor.check().wrong(sensor.path_of("table"), "expected a file's name or points { distance, value }");
            return {};
        }
        points.push_back({pair[0], pair[1]});
    }
    return points;
}

void read_table(Fields& sensor, SensorSpec& spec, bool range_given, double nothing, double minimum, double maximum,
                const RobotFileHelp& help) {
    FieldCheck& check = sensor.check();
    const FieldPath path = sensor.path_of("table");
    const FileValue& value = *sensor.field("table");
    std::vector<ResponseTable::Point> points;
    if (const std::string* file = value.text()) {
        auto read = help.read_table(*file);
        if (!read) {
            const Error& error = read.error();
            return error.place.file.empty() ? check.explain(path, error.message) : check.wrong(error);
        }
        points = std::move(*read);
    } else if (const FileTable* table = value.table()) {
        points = read_points(sensor, *table);
    } else {
        return check.wrong(
            path, fmt::format("expected a file's name or points {{ distance, value }}, got {}", kind_of(value)));
    }
    if (!check.ok()) return;
    double largest = twelve_bits;
    bool negative = false;
    for (const ResponseTable::Point& point : points) {
        largest = std::max(largest, point.value);
        negative = negative || point.value < 0;
    }
    // Beyond its last point a table fades out over as much again.
    if (!range_given && !points.empty()) spec.range = 2 * points.back().distance;
    auto made = ResponseTable::from_points(std::move(points), spec.range, nothing,
                                           minimum > -infinity ? minimum
                                           : negative          ? -largest
                                                               : 0,
                                           maximum < infinity ? maximum : largest);
    if (!made) return check.explain(path, made.error().message);
    spec.response = std::move(*made);
    spec.has_response = true;
}

void read_response(Fields& sensor, SensorSpec& spec, bool nothing_given, double nothing, double minimum, double maximum,
                   const RobotFileHelp& help) {
    FieldCheck& check = sensor.check();
    const FieldPath path = sensor.path_of("response");
    const FileValue& value = *sensor.field("response");
    if (!std::holds_alternative<FileFunction>(value.data)) {
        return check.wrong(path, fmt::format("expected a function of the distance, got {}", kind_of(value)));
    }
    std::vector<double> distances;
    for (std::size_t i = 0; i <= response_samples; ++i) {
        distances.push_back(spec.range * static_cast<double>(i) / static_cast<double>(response_samples));
    }
    if (!nothing_given) distances.push_back(infinity);
    auto values = help.call(path, distances);
    if (!values) {
        const Error& error = values.error();
        return error.place.file.empty() ? check.explain(path, error.message) : check.wrong(error);
    }
    const double at_infinity = nothing_given ? nothing : values->back();
    values->resize(response_samples + 1);
    double least = infinity;
    double greatest = -infinity;
    for (const double v : *values) {
        if (!std::isfinite(v)) continue;
        least = std::min(least, v);
        greatest = std::max(greatest, v);
    }
    if (least > greatest) return check.explain(path, "returned no finite number");
    // A formula like 1 / d has no value at 0: it gets the largest that there is, or that there may be.
    for (double& v : *values) {
        if (v == infinity) v = maximum < infinity ? maximum : greatest;
        if (v == -infinity) v = minimum > -infinity ? minimum : least;
        v = std::clamp(v, minimum, maximum);
    }
    const double last = values->back();
    const double seen_nothing = !std::isfinite(at_infinity) ? last
                                : nothing_given             ? nothing
                                                            : std::clamp(at_infinity, minimum, maximum);
    spec.response = ResponseTable::from_samples(std::move(*values), spec.range, seen_nothing);
    spec.has_response = true;
}

void read_range_sensor(Fields& sensor, SensorSpec& spec, const RobotFileHelp& help) {
    const bool range_given = sensor.number("range", spec.range, NumberRange::positive);
    sensor.number("minimum", spec.minimum, NumberRange::not_negative);
    if (spec.minimum >= spec.range)
        sensor.check().wrong(sensor.path_of("minimum"),
                             fmt::format("expected less than the range of {} m, got {}", spec.range, spec.minimum));
    sensor.number("cone", spec.cone, NumberRange::not_negative);
    std::int64_t rays = spec.cone > 0 ? 5 : 1;
    sensor.whole("rays", rays, 1, 1000);
    spec.rays = static_cast<int>(rays);
    sensor.number("noise", spec.noise, NumberRange::not_negative);

    double nothing = 0;
    double minimum = -infinity;
    double maximum = infinity;
    const bool has_table = sensor.has("table");
    const bool has_function = sensor.has("response");
    if (!has_table && !has_function) return;
    const bool nothing_given = sensor.number("nothing", nothing);
    sensor.number("min_value", minimum);
    sensor.number("max_value", maximum);
    if (minimum > maximum)
        sensor.check().explain(sensor.path_of("min_value"), fmt::format("{} is above max_value {}", minimum, maximum));
    if (has_table && has_function)
        sensor.check().wrong(sensor.path_of("response"), "is one too many beside 'table': give one of them");
    if (!sensor.check().ok()) return;
    if (has_table) {
        read_table(sensor, spec, range_given, nothing, minimum, maximum, help);
    } else {
        read_response(sensor, spec, nothing_given, nothing, minimum, maximum, help);
    }
}

SensorSpec read_sensor(const std::string& name, Fields& sensor, const BodySpec& body, const RobotFileHelp& help) {
    using Kind = SensorSpec::Kind;
    SensorSpec spec;
    spec.name = name;
    std::size_t kind = 0;
    const std::vector<std::string_view> kinds{"range", "button", "touch", "gyro", "color", "reflect"};
    sensor.require("kind", fmt::format("one of {}", fmt::join(kinds, ", ")));
    sensor.choice("kind", kind, kinds);
    spec.kind = static_cast<Kind>(kind);
    if (name == "velocity" || name == "odometry") {
        sensor.check().wrong_at(sensor.path(),
                                fmt::format("no sensor may be called '{}': that is what the wheels measure", name));
    }
    // Facts about robots are given from the chassis' centre; the body frame begins on the floor.
    Point3D at{};
    sensor.point("at", at, NumberRange::any, true);
    spec.at = {body.at.x + at.x, body.at.y + at.y, body.at.z + at.z};
    sensor.number("yaw", spec.yaw);
    sensor.text("on", spec.on);
    switch (spec.kind) {
        case Kind::range: read_range_sensor(sensor, spec, help); break;
        case Kind::touch: sensor.number("travel", spec.travel, NumberRange::not_negative); break;
        case Kind::gyro:
            sensor.number("noise", spec.noise, NumberRange::not_negative);
            sensor.number("drift", spec.drift);
            sensor.number("max_rate", spec.max_rate, NumberRange::not_negative);
            break;
        case Kind::reflect: sensor.number("noise", spec.noise, NumberRange::not_negative); break;
        case Kind::button:
        case Kind::color: break;
    }
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
    fields.number("mass", spec.mass, NumberRange::positive);
    fields.require("body", "{ shape =, size = }");
    if (fields.has("body")) spec.body = read_body(fields.inner("body"));
    fields.require("drive", "{ radius =, track =, limits = }");
    if (fields.has("drive")) spec.drive = read_drive(fields.inner("drive"), spec.body);
    for_each_named(fields, "sensors", [&](const std::string& name, Fields& entry) {
        spec.sensors.push_back(read_sensor(name, entry, spec.body, help));
    });
    for_each_named(fields, "actuators", [&](const std::string& name, Fields& entry) {
        spec.actuators.push_back(read_actuator(name, entry, spec.body));
    });
    for_each_named(fields, "ports",
                   [&](const std::string& name, Fields& entry) { spec.ports.push_back(read_port(name, entry)); });
    fields.done();
    if (check.ok()) check_carriers(check, spec);
    if (check.ok()) check_ports(check, spec);
    return spec;
}

}  // namespace nezumi
