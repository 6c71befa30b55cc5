// Always writes the whole description, because it changes rarely.
#include "bindings/web/system_json.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "bindings/web/types_json.hpp"
#include "engine/system/network.hpp"
#include "engine/trace/channel.hpp"

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

Json point(const Point2D& at) { return Json::array({at.x, at.y}); }
Json point(const Point3D& at) { return Json::array({at.x, at.y, at.z}); }

Json value_to_json(const ValueView& value) {
    if (value.type->kind == Type::Kind::text) return value.as<std::string>();
    if (value.type->kind != Type::Kind::sequence)
        return visit_number(value, [](const auto& number) { return Json(number); });
    Json all = Json::array();
    for_each_element(value, [&](const ValueView& element) {
        all.push_back(value_to_json(element));
        return true;
    });
    return all;
}

std::string_view kind_of(const Component& component) {
    if (dynamic_cast<const Robot*>(&component) != nullptr) return "robot";
    return component.script_file() != nullptr ? "behavior" : "component";
}

Json parameter_to_json(const Component& component, const Parameters::Parameter& parameter) {
    const ParameterSpec& spec = parameter.spec;
    const Value given = component.configured_value(spec);
    Json json{{"name", spec.name},
              {"type", type_text(spec.initial)},
              {"value", value_to_json(parameter.value)},
              {"default", value_to_json(spec.initial)},
              {"given", value_to_json(given)},
              {"min", spec.min ? Json(*spec.min) : Json()},
              {"max", spec.max ? Json(*spec.max) : Json()},
              {"step", spec.step},
              {"unit", spec.unit},
              {"doc", spec.doc},
              {"widget", spec.widget},
              {"options", Json::array()},
              {"changed", parameter.value != given}};
    if (spec.min_size) json["min_size"] = *spec.min_size;
    if (spec.max_size) json["max_size"] = *spec.max_size;
    for (const Value& choice : spec.choices) json["options"].push_back(value_to_json(choice));
    return json;
}

Json ports_to_json(const Component& component) {
    Json ports = Json::array();
    for (const Port* port : ports_of(component)) {
        const std::string_view way = port->direction() == Direction::in ? "in" : "out";
        ports.push_back({{"name", port->name()}, {"way", way}, {"type", port->type_name()}, {"doc", port->doc()}});
    }
    return ports;
}

// The functions that were running, the innermost first, with their local variables.
Json frames_to_json(const ErrorFrames& frames) {
    Json json = Json::array();
    for (const ErrorFrames::Frame& frame : frames.all) {
        Json locals = Json::array();
        for (const ErrorFrames::Variable& each : frame.locals) locals.push_back({each.name, each.text});
        json.push_back(
            {{"file", frame.file}, {"line", frame.line}, {"name", frame.name}, {"locals", std::move(locals)}});
    }
    return json;
}

Json component_to_json(const TreeNode& node) {
    const Component& component = *node.component();
    Json json{{"name", component.name()},       {"kind", kind_of(component)},
              {"type", component.type()},       {"state", to_text(component.state())},
              {"version", component.version()}, {"rate", component.rate}};
    if (component.state() == LifeState::error) {
        json["error"] = describe(component.last_error());
        if (const auto& frames = component.last_error().frames) json["frames"] = frames_to_json(*frames);
    }
    if (const ScriptFile* script = component.script_file()) {
        json["script"] = script->shown;
        json["about"] = component.about().description;
        Json commands = Json::array();
        for (const CommandDeclaration& command : component.commands())
            commands.push_back({{"name", command.name}, {"doc", command.doc}});
        json["commands"] = std::move(commands);
    }
    json["ports"] = ports_to_json(component);
    json["members"] = changing_members(node);
    Json parameters = Json::array();
    for (const auto& parameter : component.parameters().all())
        parameters.push_back(parameter_to_json(component, parameter));
    json["parameters"] = std::move(parameters);
    Json sets = Json::array();
    for (const auto& [name, values] : component.sets) sets.push_back(name);
    json["sets"] = std::move(sets);
    json["set"] = component.set_in_use();
    return json;
}

std::string_view kind_of(SensorSpec::Kind kind) {
    switch (kind) {
        case SensorSpec::Kind::range: return "range";
        case SensorSpec::Kind::button: return "button";
        case SensorSpec::Kind::touch: return "touch";
        case SensorSpec::Kind::gyro: return "gyro";
        case SensorSpec::Kind::color: return "color";
        case SensorSpec::Kind::reflect: return "reflect";
        case SensorSpec::Kind::ambient: return "ambient";
        case SensorSpec::Kind::scan: return "scan";
        case SensorSpec::Kind::imu: return "imu";
        case SensorSpec::Kind::neighbours: return "neighbours";
    }
    return "";
}

// For each distance of the robot, in the order of its rays: the port with its sensor's value as {port, index}, or null
// if no port has it.
Json distances_to_json(const RobotSpec& spec) {
    Json distances = Json::array();
    for (const SensorSpec& sensor : spec.sensors) {
        if (sensor.kind == SensorSpec::Kind::scan) {
            for (int ray = 0; ray < sensor.rays; ++ray) distances.push_back(nullptr);
        }
        if (sensor.kind != SensorSpec::Kind::range) continue;
        Json carrier;
        for (const PortSpec& port : spec.ports) {
            const auto item = std::find(port.items.begin(), port.items.end(), sensor.name);
            if (port.is_input || port.quantity != PortSpec::Quantity::value || item == port.items.end()) continue;
            carrier = {{"port", port.name}, {"index", item - port.items.begin()}};
            break;
        }
        distances.push_back(std::move(carrier));
    }
    return distances;
}

Json robot_to_json(const Robot& robot) {
    const RobotSpec& spec = robot.spec();
    Json sensors = Json::array();
    for (const SensorSpec& sensor : spec.sensors) {
        sensors.push_back({{"name", sensor.name},
                           {"kind", kind_of(sensor.kind)},
                           {"at", point(sensor.at)},
                           {"yaw", sensor.yaw},
                           {"range", sensor.range},
                           {"cone", sensor.cone},
                           {"rays", sensor.rays}});
    }
    const Limits& limits = robot.guard().limits();
    return {{"name", robot.name()},
            {"model", spec.model},
            {"real", robot.has_body() && robot.is_real()},
            {"twin", robot.is_twin()},
            {"may_drive", robot.may_drive()},
            {"hull",
             {{"shape", spec.body.shape == BodySpec::Shape::box ? "box" : "cylinder"},
              {"size", point(spec.body.size)},
              {"at", point(spec.body.at)}}},
            {"wheels", {{"radius", spec.drive.radius}, {"track", spec.drive.track}}},
            {"limits", {{"speed", limits.speed}, {"yaw_rate", limits.yaw_rate}}},
            {"sensors", std::move(sensors)},
            {"distances", distances_to_json(spec)}};
}

// The location of a description in a file; null if the location is not known.
Json place_to_json(const Place* place) {
    if (place == nullptr || place->line == 0) return {};
    return {{"file", place->file}, {"line", place->line}};
}

Json arena_to_json(const ArenaSpec& arena, const World* world) {
    Json json{{"size", arena.size ? point(*arena.size) : Json()}, {"border", Json()}, {"floor", Json()}};
    if (arena.border) json["border"] = {{"thickness", arena.border->thickness}, {"height", arena.border->height}};
    if (arena.floor)
        json["floor"] = {{"file", std::filesystem::path(arena.floor->image).filename().string()},
                         {"size", point(arena.floor->size)}};
    Json lines = Json::array();
    for (const LineSpec& line : arena.lines) {
        Json points = Json::array();
        for (const Point2D& at : line.points) points.push_back(point(at));
        lines.push_back({{"points", std::move(points)}, {"width", line.width}, {"color", line.color}});
    }
    json["lines"] = std::move(lines);
    std::map<std::string, const Place*> places;
    for (std::size_t i = 0; i < arena.boxes.size(); ++i) places[thing_name("box", i)] = &arena.boxes[i].place;
    for (std::size_t i = 0; i < arena.cylinders.size(); ++i)
        places[thing_name("cylinder", i)] = &arena.cylinders[i].place;
    Json things = Json::array();
    if (world != nullptr) {
        for (const ThingPose& thing : world->things())
            things.push_back({{"name", thing.name},
                              {"shape", thing.shape == ThingPose::Shape::box ? "box" : "cylinder"},
                              {"size", point(thing.size)},
                              {"color", thing.color},
                              {"place", place_to_json(places[thing.name])}});
    }
    json["things"] = std::move(things);
    return json;
}

// Calls `visit("name.port", port)` for each port of the system.
template <class Visit>
void for_each_port(const System& system, const Visit& visit) {
    for (const Component* component : system.components()) {
        for (const Port* port : ports_of(*component)) visit(*component, *port);
    }
}

// The largest number of ports shown per host. It is limited, because other hosts are not trusted.
constexpr std::size_t most_offered = 500;

Json hosts_to_json(const System& system) {
    Json hosts = Json::array();
    if (system.network() == nullptr) return hosts;
    for (const Host& host : system.network()->hosts()) {
        Json ports = Json::array();
        for (const OfferedPort& port : host.ports) {
            if (ports.size() == most_offered) break;
            ports.push_back(
                {{"name", port.name}, {"way", port.direction == Direction::in ? "in" : "out"}, {"type", port.type}});
        }
        hosts.push_back({{"name", host.name}, {"here", host.here}, {"version", host.version}, {"ports", ports}});
    }
    return hosts;
}

Json drivers_to_json(const System& system) {
    Json drivers = Json::object();
    for_each_port(system, [&](const Component& component, const Port& port) {
        if (port.override() == Override::none) return;
        const std::string path = component.name() + "." + port.name();
        const Actor* holder = system.holder(path);
        if (holder != nullptr) drivers[path] = to_text(*holder);
    });
    return drivers;
}

// The branches of the run, and the position of the present in them.
Json past_to_json(const RunningSystem& live) {
    const RunHistory& history = live.history();
    Json branches = Json::array();
    for (const RunHistory::Branch& branch : history.branches())
        branches.push_back({{"name", branch.name},
                            {"parent", history.branches()[branch.parent].name},
                            {"left", static_cast<double>(branch.left.tick) / live.system().settings().rate},
                            {"ends", branch.seconds}});
    return {{"branches", std::move(branches)},
            {"branch", history.current()},
            {"is_past", live.is_past()},
            {"away", live.is_away() ? live.back().branch : ""}};
}

}  // namespace

Json system_to_json(const RunningSystem& live) {
    const System& system = live.system();
    Json json{{"is", "system"},
              {"file", live.project().shown(live.file())},
              {"name", live.file().stem().string()},
              {"rate", system.settings().rate},
              {"start", live.generation()},
              {"starts", live.starts()},
              {"real", system.settings().real_time},
              {"stopped", system.is_stopped()},
              {"past", past_to_json(live)},
              {"components", Json::array()},
              {"connections", Json::array()}};
    const TreeNode tree = live.tree();
    for (const std::string& name : tree.children()) json["components"].push_back(component_to_json(*tree.child(name)));
    for (const ConnectionSpec& connection : system.connections())
        json["connections"].push_back({{"from", connection.from}, {"to", connection.to}});
    for (const ConnectionSpec& connection : system.foreign_connections())
        json["connections"].push_back({{"from", connection.from}, {"to", connection.to}});
    json["arena"] = arena_to_json(live.spec().arena, system.world());
    json["robots"] = Json::array();
    for (const Robot* robot : system.robots()) json["robots"].push_back(robot_to_json(*robot));
    json["markers"] = Json::array();
    if (system.world() != nullptr) {
        std::map<std::string, const Place*> places;
        for (const MarkerSpec& marker : live.spec().arena.markers) places[marker.name] = &marker.place;
        for (const MarkerPose& marker : system.world()->markers())
            json["markers"].push_back({{"name", marker.name},
                                       {"id", marker.id},
                                       {"size", marker.size},
                                       {"place", place_to_json(places[marker.name])},
                                       {"modules", system.world()->marker_cells(marker.id)}});
    }
    json["drivers"] = drivers_to_json(system);
    json["types"] = defined_types_to_json(system);
    json["hosts"] = hosts_to_json(system);
    return json;
}

std::uint64_t system_fingerprint(const RunningSystem& live) {
    const System& system = live.system();
    std::uint64_t print = 0xcbf29ce484222325U;
    const auto mix = [&](std::uint64_t value) { print = (print ^ value) * 0x100000001b3U; };
    mix(static_cast<std::uint64_t>(live.generation()));
    mix(system.layout());
    mix(live.history().branches().size());
    mix(live.is_past() ? 1 : 0);
    mix(live.is_away() ? 1 : 0);
    mix(system.is_stopped() ? 1 : 0);
    mix(system.world() != nullptr ? system.world()->markers().size() : 0);
    for (const Robot* robot : system.robots()) mix(robot->may_drive() ? 1 : 0);
    for (const Component* component : system.components()) {
        mix(static_cast<std::uint64_t>(component->state()));
        mix(static_cast<std::uint64_t>(component->version()));
        mix(component->parameters().version());
        mix(std::hash<std::string>{}(component->set_in_use()));
        for (const InPortBase* port : component->in_ports()) {
            for (const OutPortBase* source : port->sources()) mix(reinterpret_cast<std::uintptr_t>(source));
        }
    }
    for (const ConnectionSpec& connection : system.foreign_connections())
        mix(std::hash<std::string>{}(connection.from + " " + connection.to));
    if (system.network() != nullptr) mix(std::hash<std::string>{}(hosts_to_json(system).dump()));
    for_each_port(system, [&](const Component& component, const Port& port) {
        mix(static_cast<std::uint64_t>(port.override()));
        if (port.override() == Override::none) return;
        const Actor* holder = system.holder(component.name() + "." + port.name());
        if (holder != nullptr) mix(std::hash<std::string>{}(to_text(*holder)));
    });
    return print;
}

}  // namespace nezumi::web
