// Robot files with a slip: what is said, and where.
#include <catch2/catch.hpp>

#include "tests/unit/lua/robot_reader.hpp"

using namespace nezumi;
using namespace nezumi::robot_files;

TEST_CASE("a robot file that is no robot file is one plain message", "[lua][robot_file][watchdog]") {
    CHECK(robot_error("") == "r.lua: a robot file ends with `return robot_model { ... }`");
    CHECK(robot_error(with("").substr(7)) == "r.lua: a robot file ends with `return robot_model { ... }`");
    CHECK(robot_error("return {}") == "r.lua: a robot file ends with `return robot_model { ... }`");
    CHECK(robot_error("return robot_model") == "r.lua: a robot file ends with `return robot_model { ... }`");
    CHECK(robot_error("return robot_model()") == "r.lua:1: robot_model: expected a table, got nil");
    CHECK(robot_error("return robot_model 'x'") == "r.lua:1: robot_model: expected a table, got string");
    CHECK(robot_error("local a = " + with("").substr(7) + "\n" + with("")) ==
          "r.lua:3: robot_model: is called twice, first in line 1");
    CHECK_THAT(robot_error("return robot_modell {}"), Catch::StartsWith("r.lua:1:8: "));
    CHECK_THAT(robot_error("robot 'm' {}"), Catch::StartsWith("r.lua:1:1: "));
    CHECK_THAT(robot_error("return robot_model {"), Catch::StartsWith("r.lua:1: "));
    CHECK_THAT(robot_error("while true do end"), Catch::StartsWith("r.lua:1: "));
}

TEST_CASE("a robot's unknown field is told with the nearest one, at its place", "[lua][robot_file]") {
    CHECK(robot_error(with("maas = 1")) == "r.lua:2:1: robot_model: unknown field 'maas' (did you mean 'mass'?)");
    CHECK(robot_error(
              "return robot_model { mass = 1, body = { size = { 1, 1, 1 },\n shap = 'box' }, drive = { radius = 1, "
              "track = 1 } }") == "r.lua:2:2: robot_model: unknown field 'body.shap' (did you mean 'shape'?)");
    CHECK(robot_error(with("sensors = { front = {\n kind = 'range', yow = 1 } }")) ==
          "r.lua:3:18: robot_model: unknown field 'sensors.front.yow' (did you mean 'yaw'?)");
    CHECK(robot_error(with("sensors = { front = { kind = 'button', range = 1 } }")) ==
          "r.lua:2:40: robot_model: unknown field 'sensors.front.range': expected kind, at, yaw, on, port");
    CHECK(robot_error(with("sensors = { { kind = 'range' } }")) ==
          "r.lua:2:13: robot_model: unknown field 'sensors[1]': expected NAME = { ... }");
    CHECK(robot_error(with("ports = { p = { type = 'TimedPose2D', form = 'odometry' } }")) ==
          "r.lua:2:39: robot_model: unknown field 'ports.p.form' (did you mean 'from'?)");
    CHECK(robot_error(with("ports = { p = { type = 'TimedPose2D', from = 'odometry', queue = 3 } }")) ==
          "r.lua:2:58: robot_model: unknown field 'ports.p.queue': expected type, from, doc, rate, quantity");
}

TEST_CASE("a sensor that the robot needs and does not have is told", "[lua][robot_file]") {
    CHECK(
        robot_error("return robot_model { mass = 1, sensors = { eye = { kind = 'range' } },\ndrive = { radius = 0.02, "
                    "track = 0.1, needs = { 'eyes' } } }") ==
        "r.lua:2:39: robot_model: field 'drive.needs' expected sensors, there is none 'eyes' (did you mean 'eye'?)");
}

TEST_CASE("a start button that the robot does not have is told", "[lua][robot_file]") {
    CHECK(robot_error(with("sensors = { go = { kind = 'button' }, eye = { kind = 'range' } },\n"
                           "hardware = { driver = 'x', start = 'gu' }")) ==
          "r.lua:3:28: robot_model: field 'hardware.start' expected a button, there is none 'gu' (did you mean 'go'?)");
    CHECK(robot_error(with("sensors = { eye = { kind = 'range' } }, hardware = { driver = 'x', start = 'eye' }"))
              .find("expected a button, there is none 'eye'") != std::string::npos);
}

TEST_CASE("a robot's value of the wrong kind is told with its field", "[lua][robot_file]") {
    CHECK(robot_error(
              "return robot_model { mass = 0, body = { size = { 1, 1, 1 } }, drive = { radius = 1, track = 1 } }") ==
          "r.lua:1:22: robot_model: field 'mass' expected a positive number, got 0");
    CHECK(
        robot_error("return robot_model { mass = 1, body = { size = { 1, 1 } }, drive = { radius = 1, track = 1 } }") ==
        "r.lua:1:41: robot_model: field 'body.size' expected 3 numbers { x, y, z }, got 2");
    CHECK(robot_error(
              "return robot_model { mass = 1, body = { shape = 'cyl', size = { 1, 1, 1 } }, drive = { radius = 1, "
              "track = 1 } }") ==
          "r.lua:1:41: robot_model: field 'body.shape' expected one of box, cylinder, got 'cyl'");
    CHECK(robot_error(
              "return robot_model { mass = 1, body = { shape = 'cylinder', size = { 1, 2, 1 } }, drive = { radius = "
              "1, track = 1 } }") ==
          "r.lua:1:61: robot_model: field 'body.size' expected { diameter, diameter, height } of a cylinder");
    CHECK(robot_error("return robot_model { mass = 1, body = 'box', drive = { radius = 1, track = 1 } }") ==
          "r.lua:1:32: robot_model: field 'body' expected a table, got string");
    CHECK(robot_error(with("sensors = { a = { kind = 'rnage' } }")) ==
          "r.lua:2:19: robot_model: field 'sensors.a.kind' expected one of range, button, touch, gyro, color, reflect, "
          "ambient, scan, imu, got 'rnage' (did you mean 'range'?)");
    CHECK(robot_error(with("sensors = { a = 5 }")) ==
          "r.lua:2:13: robot_model: field 'sensors.a' expected a table, got number");
    CHECK(robot_error(with("sensors = { a = { kind = 'range', noise = -1 } }")) ==
          "r.lua:2:35: robot_model: field 'sensors.a.noise' expected a number from 0 on, got -1");
    CHECK(robot_error(with("sensors = { a = { kind = 'range', minimum = 0.7 } }")) ==
          "r.lua:2:35: robot_model: field 'sensors.a.minimum' expected less than the range of 0.6 m, got 0.7");
    CHECK(robot_error(with("sensors = { ['a b'] = { kind = 'range' } }")) ==
          "r.lua:2:14: robot_model: sensors: 'a b' is no name: expected letters, digits and _");
    CHECK(robot_error(with("sensors = { velocity = { kind = 'range' } }")) ==
          "r.lua:2:13: robot_model: no sensor may be called 'velocity': that is what the wheels measure");
    CHECK(robot_error(with("actuators = { a = { kind = 'servo', minimum = 1, maximum = 0 } }")) ==
          "r.lua:2:37: robot_model: field 'actuators.a.minimum': 1 is above maximum 0");
    CHECK(
        robot_error(
            with("sensors = { a = { kind = 'range', on = 'neck' } }, actuators = { neckk = { kind = 'servo' } }")) ==
        "r.lua:2:35: robot_model: field 'sensors.a.on' expected a servo, there is none 'neck' (did you mean 'neckk'?)");
}

TEST_CASE("a robot so light or small that physics can't carry it is refused", "[lua][robot_file]") {
    const auto robot = [](const std::string& mass, const std::string& body, const std::string& drive) {
        return robot_error("return robot_model { mass = " + mass + ",\nbody = { " + body + " },\ndrive = { " + drive +
                           " } }");
    };
    const std::string size = "size = { 1, 1, 1 }", drive = "radius = 1, track = 1";
    CHECK(robot("1e-9", size, drive) == "r.lua:1:22: robot_model: field 'mass' expected at least 0.001 kg, got 1e-09");
    CHECK(robot("1", "size = { 1, 1e-7, 1 }", drive) ==
          "r.lua:2:10: robot_model: field 'body.size' expected lengths of at least 0.001 m");
    CHECK(robot("1", "shape = 'cylinder', radius = 1e-7, height = 1", drive) ==
          "r.lua:2:30: robot_model: field 'body.radius' expected at least 0.001 m, got 1e-07");
    CHECK(robot("1", size, "radius = 1e-7, track = 1") ==
          "r.lua:3:11: robot_model: field 'drive.radius' expected at least 0.001 m, got 1e-07");
    CHECK(robot("1", size, "radius = 1, track = 1e-7") ==
          "r.lua:3:23: robot_model: field 'drive.track' expected at least 0.001 m, got 1e-07");
}

TEST_CASE("a hull that is all below the floor is refused", "[lua][robot_file]") {
    const auto at_height = [](const std::string& z) {
        return robot_error("return robot_model { mass = 1,\nbody = { size = { 0.1, 0.1, 0.1 }, at = { 0, 0, " + z +
                           " } },\ndrive = { radius = 0.02, track = 0.1 } }");
    };
    CHECK(at_height("-1") ==
          "r.lua:2:36: robot_model: field 'body.at' puts the hull below the floor: its top is at -0.95 m");
    CHECK(at_height("0") == "no error");
}

TEST_CASE("a robot's port can't be called what every component or robot has", "[lua][robot_file]") {
    for (const std::string name : {"truth", "collided", "status", "config"}) {
        CHECK(robot_error(with("ports = { " + name + " = { type = 'TimedPose2D', from = 'odometry' } }")) ==
              "r.lua:2:11: robot_model: port '" + name + "': the name is taken: robot." + name +
                  " is a component's own word");
    }
}

TEST_CASE("a robot's missing field is told with what belongs there", "[lua][robot_file]") {
    CHECK(robot_error("return robot_model {}") ==
          "r.lua:1: robot_model: field 'mass' is missing: expected a positive number in kg: of the "
          "whole robot");
    CHECK(robot_error("return robot_model { mass = 1 }") ==
          "r.lua:1: robot_model: field 'drive' is missing: expected { radius =, left_radius =, right_radius =, "
          "track =, pulses_per_turn =, skid =, coasts_until_commanded =, limits =, hardware_limits =, needs =, port = "
          "}: wheels, skids and limits");
    CHECK(
        robot_error("return robot_model { mass = 1, body = { size = { 1, 1, 1 } }, drive = { radius = 1 } }") ==
        "r.lua:1:63: robot_model: field 'drive.track' is missing: expected a positive number in m: between the wheels");
    CHECK(robot_error(with("sensors = { a = {} }")) ==
          "r.lua:2:13: robot_model: field 'sensors.a.kind' is missing: expected one of range, button, touch, gyro, "
          "color, reflect, ambient, scan, imu: what it measures");
    CHECK(robot_error(with("ports = { a = { to = 'drive' } }")) ==
          "r.lua:2:11: robot_model: field 'ports.a.type' is missing: expected a text: a message type");
}

TEST_CASE("a port carries something that is there and that its type fits", "[lua][robot_file]") {
    const std::string sensors =
        "sensors = { front = { kind = 'range' }, back = { kind = 'range' } }, actuators = { lamps = { kind = 'leds' } "
        "},\n";
    CHECK(robot_error(with(sensors + "ports = { p = { type = 'TimedShortSeq', from = { 'front', 'bck' } } }")) ==
          "r.lua:3:11: robot_model: port 'p': there is no sensor 'bck' (did you mean 'back'?)");
    CHECK(robot_error(with(sensors + "ports = { p = { type = 'TimedShortSek', from = 'front' } }")) ==
          "r.lua:3:11: robot_model: port 'p': unknown type 'TimedShortSek' (did you mean 'TimedShortSeq'?); `nezumi "
          "types` lists them all");
    CHECK(robot_error(with(sensors + "ports = { p = { type = 'TimedShort', from = { 'front', 'back' } } }")) ==
          "r.lua:3:11: robot_model: port 'p': a TimedShort carries one sensor, not 2");
    CHECK(robot_error(with(sensors + "ports = { p = { type = 'TimedVelocity2D', from = 'front' } }")) ==
          "r.lua:3:11: robot_model: port 'p': a TimedVelocity2D can't carry sensors' values");
    CHECK(robot_error(with(sensors + "ports = { p = { type = 'TimedPose2D', from = 'velocity' } }")) ==
          "r.lua:3:11: robot_model: port 'p': 'velocity' is a TimedVelocity2D, not a TimedPose2D");
    CHECK(robot_error(with(sensors + "ports = { p = { type = 'TimedShort', to = 'lamps' } }")) ==
          "r.lua:3:11: robot_model: port 'p': 'lamps' takes a TimedBooleanSeq, not a TimedShort");
    CHECK(robot_error(with(sensors + "ports = { p = { type = 'TimedBooleanSeq', to = 'lamp' } }")) ==
          "r.lua:3:11: robot_model: port 'p': there is no actuator 'lamp' (did you mean 'lamps'?)");
    for (const std::string both : {"", ", from = 'front', to = 'lamps'"}) {
        CHECK(robot_error(with(sensors + "ports = { p = { type = 'TimedShortSeq'" + both + " } }")) ==
              "r.lua:3:11: robot_model: port 'p': expected either 'from', what an out-port carries, or 'to', what an "
              "in-port drives");
    }
    CHECK(robot_error(with(sensors + "ports = { p = { type = 'TimedShortSeq', from = {} } }")) ==
          "r.lua:3:41: robot_model: field 'ports.p.from' expected a name or a list of names, got another table");
    CHECK_THAT(
        robot_error(with("ports = { a = { type = 'TimedVelocity2D', to = 'drive' }, b = { type = 'TimedVelocity2D', "
                         "to = 'drive' } }")),
        Catch::Contains("a robot has one in-port for its drive"));
}

TEST_CASE("bounds of values that a sensor does not have are refused", "[lua][robot_file]") {
    CHECK(robot_error(with("sensors = { a = { kind = 'range', nothing = 3 } }")) ==
          "r.lua:2:35: robot_model: field 'sensors.a.nothing' is for a sensor with a 'table' or a 'response'");
}

TEST_CASE("a response that is no function of the distance is refused", "[lua][robot_file][watchdog]") {
    const auto response = [](const std::string& what) {
        return robot_error(with("sensors = { a = { kind = 'range',\n response = " + what + " } }"));
    };
    CHECK(response("5") ==
          "r.lua:3:2: robot_model: field 'sensors.a.response' expected a function of the distance, got number");
    CHECK(response("function(d, e) return 1 end") ==
          "r.lua:3:2: robot_model: field 'sensors.a.response': its parameter 'e' is never given: leave it out");
    CHECK(response("function() end") ==
          "r.lua:3:2: robot_model: field 'sensors.a.response': returned nil for a distance of 0 m, expected a number");
    CHECK(response("function(d) return 0 / 0 end") ==
          "r.lua:3:2: robot_model: field 'sensors.a.response': returned nan for a distance of 0 m, expected a number");
    CHECK(response("function(d) return math.huge end") ==
          "r.lua:3:2: robot_model: field 'sensors.a.response': returned no finite number");
    CHECK_THAT(response("function(d)\n return d.x\n end"),
               Catch::StartsWith("r.lua:4: response(0): attempt to index a number value"));
    CHECK(response("function(d) return 1 end, table = 'ir_table.csv'") ==
          "r.lua:3:2: robot_model: field 'sensors.a.response' is one too many beside 'table': give one of them");
    CHECK_THAT(response("function(d) while true do end end"), Catch::StartsWith("r.lua:3: response(0): "));
    CHECK(robot_error(with("sensors = { a = { kind = 'range', table = 'no.csv' } }")) ==
          "r.lua:2:35: robot_model: field 'sensors.a.table': there is no file 'no.csv'; looked for "
          "engine/robots/no.csv, behaviors/no.csv");
    CHECK(robot_error(with("sensors = { a = { kind = 'range', table = { { 0.2, 1 }, { 0.1, 2 } } } }")) ==
          "r.lua:2:35: robot_model: field 'sensors.a.table': distances must ascend: 0.1 m comes after 0.2 m");
    CHECK(robot_error(with("sensors = { a = { kind = 'range', table = { 1, 2 } } }")) ==
          "r.lua:2:35: robot_model: field 'sensors.a.table' expected a file's name or points { distance, value }");
    CHECK(robot_error(
              with("sensors = { a = { kind = 'range', table = { { 0.1, 1 }, { 0.2, 2 } }, min_value = 3, max_value = "
                   "2 } }")) == "r.lua:2:71: robot_model: field 'sensors.a.min_value': 3 is above max_value 2");
}

TEST_CASE("a check of a robot file tells every unknown global", "[lua][robot_file]") {
    const Project project = Project::of(root / "engine/robots/r.lua", {root});
    CHECK(check_robot_text(with(""), "r.lua", project).empty());
    const auto errors = check_robot_text("local a = taget\nreturn robot_modell {}", "r.lua", project);
    REQUIRE(errors.size() == 2);
    CHECK(errors[0].place == Place{"r.lua", 1, 11});
    CHECK(errors[1].place == Place{"r.lua", 2, 8});
    CHECK(check_robot_text("return robot_model {}", "r.lua", project).size() == 1);
    CHECK(check_robot_text("", "r.lua", project).size() == 1);
}
