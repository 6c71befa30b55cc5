// `save` writes every field that a system file can have: one that its writer forgets is found here.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <map>
#include <set>
#include <string>

#include "bindings/cli/base/environment.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "bindings/lua/files/system_text.hpp"
#include "bindings/lua/stubs/record_annotations.hpp"
#include "engine/base/lua_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

// A system in which a structure stands, with what it needs; "%" stands for one more field, which wins over those before
// it. A field may have a system of its own.
const std::map<std::string, std::string> written_systems{
    {"box", "arena { box { at = { 1, 0, 0.1 }, size = { 0.1, 0.2, 0.3 }, % } }"},
    {"wall", "arena { wall { from = { 1, 0 }, to = { 1, 1 }, % } }"},
    {"cylinder", "arena { cylinder { at = { 1, 0, 0.1 }, radius = 0.1, height = 0.2, % } }"},
    {"marker", "arena { marker { id = 3, at = { 1, 0, 0.1 }, % } }"},
    {"maze", "arena { maze { rows = { '+--+', '|  |', '+--+' }, % } }"},
    {"maze.generate", "arena { maze { % } }"},
    {"maze_plan", "arena { maze { generate = { columns = 4, rows = 4, % } } }"},
    {"floor", "arena { floor { image = 'line.png', size = { 1, 1 }, % } }"},
    {"line", "arena { size = { 2, 2 }, line { points = { { 0, 0 }, { 0.5, 0 } }, % } }"},
    {"border", "arena { size = { 2, 2 }, border = { % } }"},
    {"arena", "arena { size = { 2, 2 }, % }"},
    {"limit_changes", "robot('m', { model = 'raspimouse', limits = { % } })"},
    {"robot", "robot('m', { model = 'raspimouse', % })"},
    {"behavior", "behavior('b', { script = 'robot_controller', sets = { slow = {} }, % })"},
    {"behavior.sets", "behavior('b', { script = 'robot_controller', % })"},
    {"component", "robot 'm' { model = 'raspimouse' } component('c', { type = 'Camera', % })"},
    {"physics", "physics { step = 0.005, % }"},
    {"network", "network { name = 'pc', % }"},
    {"network.lockstep", "network { name = 'pc', interface = 'wlan0', open = true, % }"},
    {"network.hosts", "network { name = 'pc', lockstep = true, % }"},
    {"ros", "robot 'm' { model = 'raspimouse' } ros { node = 'n', % }"},
    {"ros_topic",
     "robot 'm' { model = 'raspimouse' } ros { node = 'n', "
     "publish = { ['m.current_velocity_out'] = { topic = '/a', % } } }"},
    {"ros_topic.port",
     "robot 'm' { model = 'raspimouse' } ros { node = 'n', "
     "subscribe = { ['/a'] = { type = 'geometry_msgs/msg/TwistStamped', % } } }"},
    {"rtm", "behavior('c', { script = 'robot_controller' }) rtm { export = 'c', % }"},
    {"rtm.export", "behavior('c', { script = 'robot_controller' }) rtm { % }"},
};

// Structures that no system file has.
const std::set<std::string> others{"about",
                                   "parameter_options",
                                   "port_options",
                                   "task_options",
                                   "wait_options",
                                   "body",
                                   "drive",
                                   "sensor",
                                   "actuator",
                                   "port",
                                   "hardware",
                                   "limits",
                                   "robot_model",
                                   "pose",
                                   "marker_pose",
                                   "velocity_constraint",
                                   "hold_options",
                                   "calibration",
                                   "odometry_calibration"};

// What a field is given, as `save` writes it. Numbers and booleans need none.
const std::map<std::string, std::string> values{
    {"box.at", "{ 0.5, 0.25, 0.125 }"},
    {"box.size", "{ 0.5, 0.25, 0.125 }"},
    {"box.color", "\"#123456\""},
    {"wall.from", "{ 0.5, 0.25 }"},
    {"wall.to", "{ 0.5, 0.25 }"},
    {"wall.color", "\"#123456\""},
    {"cylinder.at", "{ 0.5, 0.25, 0.125 }"},
    {"cylinder.color", "\"#123456\""},
    {"marker.id", "7"},
    {"marker.name", "\"door\""},
    {"marker.at", "{ 0.5, 0.25, 0.125 }"},
    {"maze.rows", "{ '+--+--+', '|     |', '+--+--+' }"},
    {"maze.generate", "{ columns = 3, rows = 3 }"},
    {"maze.at", "{ 0.5, 0.25 }"},
    {"maze.thickness", "0.02"},
    {"maze_plan.columns", "3"},
    {"maze_plan.rows", "3"},
    {"maze_plan.seed", "9"},
    {"floor.size", "{ 0.5, 0.25 }"},
    {"line.points", "{ { 0.0, 0.0 }, { 0.5, -0.25 } }"},
    {"line.color", "\"#123456\""},
    {"arena.size", "{ 4.0, 3.0 }"},
    {"arena.border", "{ height = 0.25 }"},
    {"robot.model", "\"ev3\""},
    {"robot.pose", "{ x = 0.5, y = 0.25, heading = 0.125 }"},
    {"robot.limits", "{ speed = 0.25 }"},
    {"robot.backend", "\"sim\""},
    {"robot.doc", "\"a mouse\""},
    {"robot.drive", "{ radius = 0.03 }"},
    {"robot.body", "{ size = { 0.1, 0.09, 0.06 } }"},
    {"robot.sensors", "{ right_front = { noise = 8.0 } }"},
    {"robot.actuators", "{ leds = { count = 3 } }"},
    {"robot.ports", "{ switch3bit_out = false }"},
    {"robot.hardware", "{ driver = \"raspimouse\", start = \"switch1\" }"},
    {"behavior.script", "\"wall_follower\""},
    {"behavior.config", "{ speed_x = 0.5 }"},
    {"behavior.sets", "{ fast = { speed_x = 0.5 } }"},
    {"behavior.set", "\"slow\""},
    {"component.type", "\"MarkerDetector\""},
    {"component.config", "{ width = 320 }"},
    {"component.on", "\"m\""},
    {"component.at", "{ 0.5, 0.25, 0.125 }"},
    {"component.backend", "\"sim\""},
    {"network.name", "\"ev3\""},
    {"network.domain", "7"},
    {"network.interface", "\"wlan0\""},
    {"network.peers", "{ \"10.0.0.1\" }"},
    {"network.secret", "\"key\""},
    {"network.hosts", "{ \"ev3\" }"},
    {"ros.node", "\"other\""},
    {"ros.publish", "{ [\"m.current_velocity_out\"] = \"/a\" }"},
    {"ros.subscribe", "{ [\"/a\"] = \"m.target_velocity_in\" }"},
    {"ros.domain", "7"},
    {"ros.interface", "\"wlan0\""},
    {"ros.peers", "{ \"10.0.0.1\" }"},
    {"ros_topic.topic", "\"/b\""},
    {"ros_topic.port", "\"m.target_velocity_in\""},
    {"ros_topic.type", "\"geometry_msgs/msg/TwistStamped\""},
    {"ros_topic.frame", "\"body\""},
    {"rtm.nameserver", "{ \"pc:2810\" }"},
    {"rtm.export", "{ \"c\" }"},
    {"rtm.interface", "\"10.0.0.1\""},
    {"rtm.rename", "{ [\"c.in\"] = \"ir\" }"},
};

std::string value_of(const RecordShape& record, const FieldRow& row) {
    if (const auto found = values.find(record.name + "." + row.name); found != values.end()) return found->second;
    if (row.name == "image") return lua_quoted(source_root() + "/docs/images/flock.png");
    if (row.type == "number") return record.name == "physics" ? "0.01" : "0.25";
    if (row.type == "boolean") return row.fallback == "true" ? "false" : "true";
    return "";
}

// Generators become boxes, a robot's fields of its model's file are written as they came, topics by their names.
bool is_written_as_it_is(const RecordShape& record, const FieldRow& row) {
    if (record.name == "wall" || record.name == "maze" || record.name == "maze_plan") return false;
    if (record.name == "ros_topic") return row.name == "frame" || row.name == "type";
    if (record.name == "ros") return row.name != "publish" && row.name != "subscribe";
    return record.name != "robot" || row.fallback != "as of the model";
}

SystemSpec read(const std::string& text) {
    static const Scratch folder;
    folder.write("behaviors/systems/m.calibration.lua", "calibration { robot = 'm', model = 'raspimouse' }");
    const std::filesystem::path file = folder.path("behaviors/systems/s.lua");
    auto spec =
        read_system_text(text, file.string(), Project::of(file, {source_root()}), {.peer_words = cli::peer_words()});
    INFO(text);
    INFO((spec ? std::string() : describe(spec.error())));
    REQUIRE(spec.has_value());
    return std::move(*spec);
}

}  // namespace

TEST_CASE("every field that a system file can have is written by save and read back", "[cli][fields]") {
    std::size_t tried = 0;
    for (const RecordShape& record : file_records(cli::peer_words())) {
        CAPTURE(record.name);
        CHECK(written_systems.contains(record.name) != others.contains(record.name));
        if (!written_systems.contains(record.name)) continue;
        for (const FieldRow& row : record.rows) {
            CAPTURE(row.name);
            if (record.name == "component" && row.name == "calibration") continue;  // its values are in `config`
            const std::string value = value_of(record, row);
            REQUIRE_FALSE(value.empty());
            const auto own = written_systems.find(record.name + "." + row.name);
            const std::string& system = own != written_systems.end() ? own->second : written_systems.at(record.name);
            const auto with = [&](const std::string& field) {
                return write_system_text(read(std::string(system).replace(system.find('%'), 1, field)), "Saved");
            };
            const std::string field = fmt::format("{} = {}", row.name, value);
            const std::string written = with(field);
            CHECK(write_system_text(read(written), "Saved") == written);
            if (is_written_as_it_is(record, row)) CHECK_THAT(written, Catch::Contains(field));
            if (own == written_systems.end()) CHECK(written != with(""));
            ++tried;
        }
    }
    CHECK(tried > 80);
}
