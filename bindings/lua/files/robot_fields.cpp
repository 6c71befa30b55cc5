// Body, drive, sensors, actuators and ports of a robot file, each field checked.
#include "bindings/lua/files/robot_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/list.hpp"
#include "engine/base/names.hpp"
#include "engine/devices/wired_device.hpp"
#include "engine/records/read_record.hpp"
#include "engine/robot/robot.hpp"
#include "engine/tree/member.hpp"
#include "engine/world/robot_fields.hpp"

namespace nezumi {
namespace {

// Calls `read(name, fields)` for each entry of a table of named tables.
template <class Read>
void for_each_named(Fields& fields, std::string_view group, Read&& read) {
    Fields named = fields.inner(group);
    for (const auto& [name, value] : named.all()) {
        named.field(name);
        if (!is_identifier(name) && !is_keyword(name)) {
            fields.check().wrong_at(
                named.path_of(name),
                fmt::format("{}: '{}' is not a valid name: expected letters, digits and _", group, name));
            continue;
        }
        Fields entry(fields.check(), value, named.path_of(name));
        read(name, entry);
        entry.done();
    }
    named.done([](std::string_view) -> std::string { return ": expected NAME = { ... }"; });
}

double height_on_floor(const BodySpec& body) { return hull_clearance + body.size.z / 2; }

// The default hull: a box about as long and as wide as the track.
BodySpec body_over(double track) {
    BodySpec spec;
    spec.size = {1.1 * track, 0.9 * track, 0.65 * track};
    spec.at = {0, 0, height_on_floor(spec)};
    return spec;
}

BodySpec read_body(Fields body) {
    BodySpec spec;
    spec.at = {0, 0, std::numeric_limits<double>::quiet_NaN()};
    read_record(body, spec);
    const bool is_cylinder = spec.shape == BodySpec::Shape::cylinder;
    const Rule positive{.range = NumberRange::positive, .least = least_robot_length};
    if (is_cylinder && (body.gives("radius") || body.gives("height"))) {
        double radius = 0, height = 0;
        body.number("radius", radius, positive, "m");
        body.number("height", height, positive, "m");
        body.require("radius", "metres");
        body.require("height", "metres");
        spec.size = {2 * radius, 2 * radius, height};
    } else {
        body.require("size", "{ length, width, height } in m");
        if (body.point("size", spec.size, positive.range))
            body.check_lengths("size", positive, "m", {{spec.size.x, spec.size.y, spec.size.z}});
    }
    if (is_cylinder && spec.size.x != spec.size.y)
        body.check().wrong(body.path_of("size"), "expected { diameter, diameter, height } of a cylinder");
    if (std::isnan(spec.at.z)) spec.at.z = height_on_floor(spec);
    const double top = spec.at.z + spec.size.z / 2;
    if (body.check().ok() && top <= 0)
        body.check().wrong(body.path_of("at"), fmt::format("puts the hull below the floor: its top is at {:g} m", top));
    body.done();
    return spec;
}

DriveSpec read_drive(Fields drive) {
    DriveSpec spec;
    spec.skid = 0;
    // Limits of the hardware that the file does not set are the limits of the simulation.
    Fields limits = drive.inner("limits");
    read_record(limits, spec.limits, {.is_whole = false});
    limits.done();
    spec.hardware_limits = spec.limits;
    read_record(drive, spec);
    drive.done();
    return spec;
}

ActuatorSpec read_actuator(const std::string& name, Fields& actuator, const BodySpec& body) {
    ActuatorSpec spec;
    spec.name = name;
    read_record(actuator, spec);
    if (spec.minimum > spec.maximum)
        actuator.check().explain(actuator.path_of("minimum"),
                                 fmt::format("{} is above maximum {}", spec.minimum, spec.maximum));
    if (spec.kind == ActuatorSpec::Kind::servo) spec.at = on_body(body, spec.at);
    return spec;
}

PortSpec read_port(const std::string& name, Fields& port) {
    PortSpec spec;
    spec.name = name;
    spec.is_input = port.gives("to");
    if (port.gives("from") == spec.is_input) {
        port.field("from");  // marks it as known: one error is enough if both exist
        port.check().wrong_at(
            port.path(),
            fmt::format(
                "port '{}': expected either 'from' (the source of an out-port) or 'to' (the target of an in-port)",
                name));
    }
    read_record(port, spec, {.kind = spec.is_input ? Describe<PortSpec>::in_only : Describe<PortSpec>::out_only});
    if (port.check().ok() && spec.items.empty())
        port.check().wrong(port.path_of(spec.is_input ? "to" : "from"),
                           "expected a name or a list of names, got another table");
    return spec;
}

// Adds the usual ports of a robot with wheels, each unless the file has a port for the same data.
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
        if (sensor.on.empty() || contains(servos, sensor.on)) continue;
        check.wrong({"sensors", sensor.name, "on"}, fmt::format("expected a servo, but there is no servo '{}'{}",
                                                                sensor.on, did_you_mean(sensor.on, servos)));
    }
}

void check_needs(FieldCheck& check, const RobotSpec& spec) {
    std::vector<std::string_view> names;
    for (const SensorSpec& sensor : spec.sensors) names.push_back(sensor.name);
    for (const std::string& need : spec.drive.needs) {
        if (!contains(names, need))
            check.wrong({"drive", "needs"}, fmt::format("expected sensors, but there is no sensor '{}'{}", shown(need),
                                                        did_you_mean(need, names)));
    }
}

void check_hardware(FieldCheck& check, const RobotSpec& spec, const std::vector<std::string>& drivers) {
    const std::string& driver = spec.hardware.driver;
    const std::vector<std::string_view> known(drivers.begin(), drivers.end());
    if (!driver.empty() && !known.empty() && !contains(known, driver)) {
        std::string hint = did_you_mean(driver, known);
        if (hint.empty()) hint = fmt::format("; there are {}", fmt::join(known, ", "));
        check.wrong({"hardware", "driver"},
                    fmt::format("expected a driver, but there is no driver '{}'{}", shown(driver), hint));
    }
    std::vector<std::string_view> buttons;
    for (const SensorSpec& sensor : spec.sensors) {
        if (sensor.kind == SensorSpec::Kind::button) buttons.push_back(sensor.name);
    }
    for (const auto& [field, button] :
         {std::pair("start", &spec.hardware.start), {"shutdown", &spec.hardware.shutdown}}) {
        if (button->empty() || contains(buttons, *button)) continue;
        check.wrong({"hardware", field}, fmt::format("expected a button, but there is no button '{}'{}", shown(*button),
                                                     did_you_mean(*button, buttons)));
    }
}

// Reads `line = serial { ... }`. `safe = false` means that the device only measures.
DeviceSpec read_device(const std::string& name, Fields& device) {
    DeviceSpec spec;
    spec.name = name;
    spec.place = device.check().place_of(device.path());
    std::vector<std::string_view> words;
    for (const DeviceKind& kind : device_kinds()) words.push_back(kind.word);
    std::size_t index = 0;
    if (!device.choice("kind", index, words)) {
        device.require("kind", fmt::format("{} {{ ... }}", fmt::join(words, ", ")));
        for (const auto& [field, value] : device.all()) device.field(field);
        return spec;
    }
    const DeviceKind& kind = device_kinds()[index];
    spec.type = kind.type;
    for (const ParameterSpec& parameter : kind.parameters) {
        const Value* given = parameter.name == "measures_only" ? nullptr : device.field(parameter.name);
        if (given == nullptr) continue;
        const bool* truth = given->get_if<bool>();
        if (parameter.name == "safe" && truth != nullptr && !*truth) {
            spec.config.insert_or_assign("measures_only", true);
            continue;
        }
        auto value = to_parameter(*given);
        if (value) value = check_value(parameter, *value);
        if (value) {
            spec.config.insert_or_assign(parameter.name, std::move(*value));
        } else {
            device.check().wrong_at(device.path_of(parameter.name), value.error().message);
        }
    }
    Parameters parameters;
    for (const ParameterSpec& parameter : kind.parameters) static_cast<void>(parameters.declare(parameter));
    if (kind.check != nullptr && parameters.set_all(spec.config)) {
        if (const std::string wrong = kind.check(parameters); !wrong.empty())
            device.check().wrong_at(device.path(), fmt::format("device '{}': {}", name, wrong));
    }
    return spec;
}

void read_hardware(Fields hardware, RobotSpec& robot, const RobotFileHelp& help) {
    HardwareSpec& spec = robot.hardware;
    FieldCheck& check = hardware.check();
    read_record(hardware, spec);
    for_each_named(hardware, "devices",
                   [&](const std::string& name, Fields& entry) { spec.devices.push_back(read_device(name, entry)); });
    hardware.done();
    if (spec.driver.empty() == spec.script.empty())
        check.explain(hardware.path_of(spec.driver.empty() ? "driver" : "script"),
                      "expected either 'driver', a driver of nezumi, or 'script', a behaviour that drives the robot");
    if (spec.script.empty() && !(spec.devices.empty() && spec.device_model.empty()))
        check.explain(hardware.path_of("devices"), "'devices' and 'device_model' can be used only with 'script'");
    const auto find = [&](const char* field, const std::string& name, std::string& file) {
        if (name.empty() || !help.find_script) return;
        const auto found = help.find_script(hardware.path_of(field), name);
        found ? static_cast<void>(file = *found) : check.wrong_at(hardware.path_of(field), found.error().message);
    };
    find("script", spec.script, spec.script_file);
    find("device_model", spec.device_model, spec.device_model_file);
}

// Makes a robot to check its ports, because only `Robot` knows which type a port can have. Makes one for each port, so
// that each error has the location of its port.
void check_ports(FieldCheck& check, const RobotSpec& spec) {
    RobotSpec one = spec;
    for (SensorSpec& sensor : one.sensors) sensor.response = {};
    for (const PortSpec& port : spec.ports) {
        one.ports = {port};
        if (auto robot = Robot::make("check", one, {}); !robot)
            check.wrong_at({"ports", port.name}, robot.error().message);
    }
    one.ports = spec.ports;
    if (auto robot = Robot::make("check", one, {}); !robot) check.wrong_at({"ports"}, robot.error().message);
}

}  // namespace

// Positions in robot files are relative to the chassis' centre; the origin of the body frame is on the floor.
Point3D on_body(const BodySpec& body, const Point3D& at) {
    return {body.at.x + at.x, body.at.y + at.y, body.at.z + at.z};
}

RobotSpec read_robot_fields(FieldCheck& check, const Value& value, const RobotFileHelp& help) {
    RobotSpec spec;
    Fields fields(check, value);
    read_record(fields, spec);
    if (fields.has("drive")) spec.drive = read_drive(fields.inner("drive"));
    spec.body = fields.has("body") ? read_body(fields.inner("body")) : body_over(spec.drive.track);
    if (spec.drive.skid == 0) spec.drive.skid = 0.4 * spec.body.size.x;
    if (fields.has("hardware")) read_hardware(fields.inner("hardware"), spec, help);
    for_each_named(fields, "sensors", [&](const std::string& name, Fields& entry) {
        spec.sensors.push_back(read_sensor_fields(name, entry, spec.body, help));
    });
    for_each_named(fields, "actuators", [&](const std::string& name, Fields& entry) {
        spec.actuators.push_back(read_actuator(name, entry, spec.body));
    });
    for_each_named(fields, "ports", [&](const std::string& name, Fields& entry) {
        const auto& words = names_taken_by_robots();
        if (contains(words, name)) {
            check.wrong_at(
                entry.path(),
                fmt::format("port '{0}': the name is already used: robot.{0} is a member of every component", name));
        }
        spec.ports.push_back(read_port(name, entry));
    });
    fields.done();
    add_wheel_ports(spec);
    if (check.ok()) check_carriers(check, spec);
    if (check.ok()) check_needs(check, spec);
    if (check.ok()) check_hardware(check, spec, help.drivers);
    if (check.ok()) check_ports(check, spec);
    return spec;
}

}  // namespace nezumi
