// System files: what they may say, and what is said about a slip.
#include "bindings/lua/system_file.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <numbers>

#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

const std::filesystem::path root = NEZUMI_SOURCE_ROOT;

// Reads a text as the file behaviors/systems/s.lua of the project's own sources.
Expected<SystemSpec> read(std::string_view text, const SystemFileOptions& options = {}) {
    const Project project = Project::of(root / "behaviors/systems/s.lua", {root});
    return read_system_text(text, "behaviors/systems/s.lua", project, options);
}

SystemSpec system_of(std::string_view text) {
    auto spec = read(text);
    INFO((spec ? std::string() : describe(spec.error())));
    REQUIRE(spec.has_value());
    return std::move(*spec);
}

// The error without the folders of the file.
std::string error(std::string_view text) {
    const auto spec = read(text);
    if (!spec && spec.error().place.file == "behaviors/systems/s.lua") return describe(spec.error()).substr(18);
    return spec ? "no error" : describe(spec.error());
}

template <class T>
const T& entry(const SystemSpec& spec, std::size_t index) {
    REQUIRE(index < spec.entries.size());
    return std::get<T>(spec.entries[index]);
}

}  // namespace

TEST_CASE("the tutorial's system is read whole", "[lua][system_file]") {
    const Project project = Project::of(root / "behaviors/systems/stop_at_wall.lua", {root});
    const auto spec = read_system_file(root / "behaviors/systems/stop_at_wall.lua", project);
    INFO((spec ? std::string() : describe(spec.error())));
    REQUIRE(spec.has_value());
    CHECK(spec->file == "behaviors/systems/stop_at_wall.lua");
    CHECK(spec->rate == 100);
    CHECK(spec->physics_step == 0.005);
    CHECK_FALSE(spec->seed.has_value());
    REQUIRE(spec->arena.boxes.size() == 1);
    CHECK(spec->arena.boxes[0].at == Point3D{0.8, 0.0, 0.15});
    CHECK(spec->arena.boxes[0].size == Point3D{0.1, 1.0, 0.3});
    CHECK(spec->arena.boxes[0].place == Place{"behaviors/systems/stop_at_wall.lua", 2});
    const auto& mouse = entry<RobotEntry>(*spec, 0);
    CHECK(mouse.name == "mouse");
    CHECK(mouse.model == "raspimouse");
    CHECK(mouse.pose == Pose2D{});
    CHECK(mouse.active);
    CHECK(mouse.place == Place{"behaviors/systems/stop_at_wall.lua", 4});
    const auto& controller = entry<BehaviorEntry>(*spec, 1);
    CHECK(controller.script == "robot_controller");
    CHECK(controller.path == "behaviors/robot_controller.lua");
    CHECK(controller.config == ParameterValues{{"speed_x", 0.1}});
    REQUIRE(spec->connections.size() == 2);
    CHECK(spec->connections[0].from == "mouse.ir_sensor_out");
    CHECK(spec->connections[0].to == "controller.in");
    CHECK(spec->connections[1].place == Place{"behaviors/systems/stop_at_wall.lua", 8});
    REQUIRE(spec->models.contains("raspimouse"));
    CHECK(spec->models.at("raspimouse").mass == 0.72);
    CHECK(spec->files == std::vector<std::string>{"behaviors/systems/stop_at_wall.lua", "engine/robots/raspimouse.lua",
                                                  "engine/robots/ir_table.csv"});
}

TEST_CASE("a robot takes its model, pose, limits, driver and whether it starts", "[lua][system_file]") {
    const auto spec = system_of(R"(
        robot("m", { model = "raspimouse.lua", pose = { x = 1, y = -2.5, heading = math.pi }, limits = { speed = 2.0, yaw_rate = 8,
              acceleration = 1, yaw_acceleration = 3 }, backend = "raspimouse", active = false }))");
    const auto& m = entry<RobotEntry>(spec, 0);
    CHECK(m.model == "raspimouse.lua");
    CHECK(spec.models.contains("raspimouse.lua"));
    CHECK(m.pose == Pose2D{{1, -2.5}, std::numbers::pi});
    CHECK(m.speed == 2.0);
    CHECK(m.yaw_rate == 8.0);
    CHECK(m.acceleration == 1.0);
    CHECK(m.yaw_acceleration == 3.0);
    CHECK(m.backend == "raspimouse");
    CHECK_FALSE(m.active);
    CHECK_FALSE(entry<RobotEntry>(system_of("robot 'm' { model = 'raspimouse', limits = { speed = 1 } }"), 0)
                    .yaw_rate.has_value());
}

TEST_CASE("a behaviour takes values of every type, sets and a rate", "[lua][system_file]") {
    const auto spec = system_of(R"(behavior "c" { script = "robot_controller.lua", rate = 50, active = false,
        config = { a = 1, b = 1.0, c = true, d = "text", e = { 1, 2 }, f = { 1, 2.5 }, g = { "x" }, h = { true, false }, i = {} },
        sets = { careful = { a = 2 }, fast = { b = 3.5 } }, set = "careful" })");
    const auto& c = entry<BehaviorEntry>(spec, 0);
    CHECK(c.rate == 50);
    CHECK_FALSE(c.active);
    CHECK(c.path == "behaviors/robot_controller.lua");
    CHECK(c.config.at("a") == ParameterValue{std::int64_t{1}});
    CHECK(c.config.at("b") == ParameterValue{1.0});
    CHECK(c.config.at("c") == ParameterValue{true});
    CHECK(c.config.at("d") == ParameterValue{std::string("text")});
    CHECK(c.config.at("e") == ParameterValue{std::vector<std::int64_t>{1, 2}});
    CHECK(c.config.at("f") == ParameterValue{std::vector<double>{1, 2.5}});
    CHECK(c.config.at("g") == ParameterValue{std::vector<std::string>{"x"}});
    CHECK(c.config.at("h") == ParameterValue{std::vector<bool>{true, false}});
    CHECK(to_text(c.config.at("i")) == "{}");
    CHECK(c.sets.at("careful") == ParameterValues{{"a", std::int64_t{2}}});
    CHECK(c.sets.at("fast") == ParameterValues{{"b", 3.5}});
    CHECK(c.set == "careful");
}

TEST_CASE("a native component takes its type, place and carrier", "[lua][system_file]") {
    const auto spec = system_of(R"(
        component "eye" { type = "Camera", on = "m", at = { 0.05, 0, 0.08 }, yaw = 0.1, rate = 30, config = { width = 640 } }
        robot "m" { model = "raspimouse" })");
    const auto& eye = entry<ComponentEntry>(spec, 0);
    CHECK(eye.type == "Camera");
    CHECK(eye.on == "m");
    CHECK(eye.at == Point3D{0.05, 0, 0.08});
    CHECK(eye.yaw == 0.1);
    CHECK(eye.rate == 30);
    CHECK(eye.config == ParameterValues{{"width", std::int64_t{640}}});
}

TEST_CASE("an arena holds boxes, walls, cylinders, markers and a size", "[lua][system_file]") {
    const auto spec = system_of(R"(
        arena {
          size = { 4, 3 }, border = false,
          box { at = { 1, 2, 0.5 }, size = { 0.1, 0.2, 0.3 }, yaw = 0.5, color = "#00FF7f", mass = 0.2 },
          wall { from = { 0, 0 }, to = { 0, 2 }, height = 0.4, thickness = 0.05 },
          cylinder { at = { 1, 1 }, radius = 0.1, height = 0.2, mass = 1, color = "red" },
          marker { name = "door", id = 7, size = 0.08, at = { 2, 0, 0.1 }, facing = math.pi },
        }
        arena { box { at = { x = 3, y = 0 }, size = { x = 1, y = 1, z = 1 } } })");
    CHECK(spec.arena.size == Point2D{4, 3});
    CHECK_FALSE(spec.arena.border);
    REQUIRE(spec.arena.boxes.size() == 3);
    CHECK(spec.arena.boxes[0].yaw == 0.5);
    CHECK(spec.arena.boxes[0].mass == 0.2);
    CHECK(spec.arena.boxes[0].color == "#00FF7f");
    CHECK(spec.arena.boxes[0].place.line == 4);
    const BoxSpec& wall = spec.arena.boxes[1];
    CHECK(wall.at == Point3D{0, 1, 0.2});
    CHECK(wall.size == Point3D{2, 0.05, 0.4});
    CHECK(wall.yaw == Approx(std::numbers::pi / 2));
    CHECK(wall.mass == 0);
    CHECK(spec.arena.boxes[2].at == Point3D{3, 0, 0.5});
    REQUIRE(spec.arena.cylinders.size() == 1);
    CHECK(spec.arena.cylinders[0].at == Point3D{1, 1, 0.1});
    CHECK(spec.arena.cylinders[0].radius == 0.1);
    CHECK(spec.arena.cylinders[0].mass == 1);
    CHECK(spec.arena.cylinders[0].color == "#d6453d");
    REQUIRE(spec.arena.markers.size() == 1);
    CHECK(spec.arena.markers[0].name == "door");
    CHECK(spec.arena.markers[0].id == 7);
    CHECK(spec.arena.markers[0].size == 0.08);
    CHECK(spec.arena.markers[0].facing == Approx(std::numbers::pi));
}

TEST_CASE("an arena has a border unless it says otherwise", "[lua][system_file]") {
    CHECK(system_of("arena { size = { 1, 1 } }").arena.border);
    const auto spec = system_of("arena { size = { 1, 1 }, border = { height = 0.3, thickness = 0.05 } }");
    CHECK(spec.arena.border);
    CHECK(spec.arena.border_height == 0.3);
    CHECK(spec.arena.border_thickness == 0.05);
    CHECK_FALSE(system_of("arena { box { at = { 0, 0 }, size = { 1, 1, 1 } } }").arena.size.has_value());
    CHECK(system_of("arena { box { at = { 0, 0 }, size = { 1, 1, 1 }, pitch = -0.2 } }").arena.boxes[0].pitch == -0.2);
}

TEST_CASE("things of an arena may come from loops, functions and lists", "[lua][system_file]") {
    const auto spec = system_of(R"(
        local function post(x) return cylinder { at = { x, 0 }, radius = 0.05, height = 0.2 } end
        local posts = {}
        for i = 1, 5 do posts[i] = post(i) end
        arena { posts, post(9) }
        arena(setmetatable({ post(10) }, {})))");
    REQUIRE(spec.arena.cylinders.size() == 7);
    CHECK(spec.arena.cylinders[4].at.x == 5);
    CHECK(spec.arena.cylinders[5].at.x == 9);
    CHECK(spec.arena.cylinders[0].place.line == 2);
}

TEST_CASE("a map's boxes are in the arena", "[lua][system_file]") {
    const Scratch scratch;
    scratch.write("behaviors/map.csv", "x,y,z,lx,ly,lz,yaw\n1,2,3,4,5,6,7\n");
    const Project project = Project::of(scratch.path("s.lua"));
    const auto spec = read_system_text("arena { csv 'map.csv' }", scratch.path("s.lua").string(), project);
    REQUIRE(spec.has_value());
    REQUIRE(spec->arena.boxes.size() == 1);
    CHECK(spec->arena.boxes[0].size == Point3D{4, 5, 6});
    CHECK(spec->files.size() == 2);
    scratch.write("behaviors/map.csv", "x,y,z,lx,ly,lz,yaw\n\n1,2,3,abc,5,6,7\n");
    const auto bad = read_system_text("arena { csv 'map.csv' }", "s.lua", project);
    REQUIRE_FALSE(bad.has_value());
    CHECK(bad.error().place.line == 3);
    CHECK(bad.error().message == "column 'lx': expected a positive number, got 'abc'");
}

TEST_CASE("seed, rate and the physics step are set once", "[lua][system_file]") {
    const auto spec = system_of("seed(42) rate(50) physics { step = 0.01 }");
    CHECK(spec.seed == 42);
    CHECK(spec.rate == 50);
    CHECK(spec.rate_place.line == 1);
    CHECK(spec.physics_step == 0.01);
    CHECK(error("seed(1)\nseed(1)") == "s.lua:2: seed: is set already, at behaviors/systems/s.lua:1");
    CHECK(error("rate(50)\nrate(50)") == "s.lua:2: rate: is set already, at behaviors/systems/s.lua:1");
    CHECK(error("physics { step = 0.01 }\nphysics { step = 0.01 }") ==
          "s.lua:2: physics: is set already, at behaviors/systems/s.lua:1");
    CHECK(error("seed(-1)") == "s.lua:1: seed: expected a whole number from 0 on, got -1");
    CHECK(error("seed(1.5)") == "s.lua:1: seed: expected a whole number from 0 on, got 1.5");
    CHECK(system_of("seed(1e3)").seed == 1000);
    CHECK(error("seed 'x'") == "s.lua:1: seed: expected a whole number from 0 on, got string");
    CHECK(error("rate(0)") == "s.lua:1: rate: expected a positive number of ticks a second, got 0");
    CHECK(error("rate(0/0)") == "s.lua:1: rate: expected a positive number of ticks a second, got nan");
    CHECK(error("rate {}") == "s.lua:1: rate: expected a positive number of ticks a second, got table");
    CHECK(error("rate()") == "s.lua:1: rate: expected an argument, got none");
    CHECK(error("physics { step = -1 }") == "s.lua:1:11: physics: field 'step' expected a positive number, got -1");
    CHECK(error("physics { stepp = 1 }") == "s.lua:1:11: physics: unknown field 'stepp' (did you mean 'step'?)");
    CHECK(error("physics {}") == "s.lua:1: physics: field 'step' is missing: expected seconds, for example 0.005");
}

TEST_CASE("a tick is a whole number of physics steps", "[lua][system_file]") {
    CHECK(error("-- tick\nrate(60)") ==
          "s.lua:2: rate: a tick of 60 Hz is no whole number of physics steps of 0.005 s; the nearest rates are 50 or "
          "66.6667 Hz");
    CHECK_THAT(error("physics { step = 0.003 }"),
               Catch::StartsWith("s.lua:1: rate: a tick of 100 Hz is no whole number"));
    CHECK(system_of("rate(200)").rate == 200);
}

TEST_CASE("a component's rate is at most the tick's", "[lua][system_file]") {
    CHECK(error("behavior 'c' { script = 'robot_controller',\n rate = 200 }") ==
          "s.lua:2:2: behavior 'c': a rate of 200 Hz is above the tick's 100 Hz: lower it, or raise the tick with "
          "rate(...)");
    CHECK(error("component 'c' { type = 'Joystick', rate = 101 }").find("component 'c': a rate of 101 Hz") !=
          std::string::npos);
    CHECK(
        entry<BehaviorEntry>(system_of("behavior 'c' { script = 'robot_controller', rate = 200 } rate(200)"), 0).rate ==
        200);
    CHECK(error("behavior 'c' { script = 'robot_controller', rate = 0 }") ==
          "s.lua:1:45: behavior 'c': field 'rate' expected a positive number, got 0");
}

TEST_CASE("classrooms of robots are made by loops", "[lua][system_file]") {
    const auto spec = system_of(R"(
        local config = { speed_x = 0.0 }
        for i = 1, 20 do
          config.speed_x = i / 100
          robot("mouse" .. i, { model = "raspimouse", pose = { x = i } })
          behavior("controller" .. i, { script = "robot_controller", config = config })
          connect("mouse" .. i .. ".ir_sensor_out", "controller" .. i .. ".in")
        end)");
    CHECK(spec.entries.size() == 40);
    CHECK(spec.connections.size() == 20);
    CHECK(entry<BehaviorEntry>(spec, 1).config.at("speed_x") == ParameterValue{0.01});
    CHECK(entry<BehaviorEntry>(spec, 39).config.at("speed_x") == ParameterValue{0.2});
    CHECK(entry<BehaviorEntry>(spec, 39).place.line == 6);
}

TEST_CASE("an unknown field is told with the nearest one, at its place", "[lua][system_file]") {
    CHECK(error("robot 'm' {\n  modell = 'raspimouse' }") ==
          "s.lua:2:3: robot 'm': unknown field 'modell' (did you mean 'model'?)");
    CHECK(error("robot 'm' { model = 'raspimouse',\n  pose = {\n x = 1,\n heding = 2 } }") ==
          "s.lua:4:2: robot 'm': unknown field 'pose.heding' (did you mean 'heading'?)");
    CHECK(error("robot('m', { model = 'raspimouse', limits = { sped = 2 } })") ==
          "s.lua:1:47: robot 'm': unknown field 'limits.sped' (did you mean 'speed'?)");
    CHECK(error("behavior 'c' { script = 'robot_controller', speed_x = 1 }") ==
          "s.lua:1:45: behavior 'c': unknown field 'speed_x': expected script, config, sets, set, rate, active");
    CHECK(error("behavior 'c' { 'robot_controller' }") ==
          "s.lua:1:16: behavior 'c': unknown field '[1]': expected script, config, sets, set, rate, active");
    CHECK(error("component 'c' { typ = 'Camera' }") ==
          "s.lua:1:17: component 'c': unknown field 'typ' (did you mean 'type'?)");
    CHECK(error("arena {\n box { at = { 1, 0, 0 }, sise = { 1, 1, 1 } } }") ==
          "s.lua:2:26: box: unknown field 'sise' (did you mean 'size'?)");
    CHECK(error("arena { siz = { 1, 1 } }") == "s.lua:1:9: arena: unknown field 'siz' (did you mean 'size'?)");
    CHECK(error("arena { box = { at = { 0, 0 }, size = { 1, 1, 1 } } }") ==
          "s.lua:1:9: arena: unknown field 'box': write box { ... }, without =");
    CHECK(error("arena { csv = 'map.csv' }") ==
          "s.lua:1:9: arena: unknown field 'csv': write csv \"map.csv\", without =");
}

TEST_CASE("a value of the wrong kind is told with its field", "[lua][system_file]") {
    CHECK(error("robot 'm' { model = 5 }") == "s.lua:1:13: robot 'm': field 'model' expected a text, got number");
    CHECK(error("robot 'm' { model = 'raspimouse', pose = { x = '1' } }") ==
          "s.lua:1:44: robot 'm': field 'pose.x' expected a number, got string");
    CHECK(error("robot 'm' { model = 'raspimouse', pose = { heading = 0/0 } }") ==
          "s.lua:1:44: robot 'm': field 'pose.heading' expected a finite number, got nan");
    CHECK(error("robot 'm' { model = 'raspimouse', pose = { y = math.huge } }") ==
          "s.lua:1:44: robot 'm': field 'pose.y' expected a finite number, got inf");
    CHECK(error("robot 'm' { model = 'raspimouse', pose = 3 }") ==
          "s.lua:1:35: robot 'm': field 'pose' expected a table, got number");
    CHECK(error("robot 'm' { model = 'raspimouse', limits = { speed = 0 } }") ==
          "s.lua:1:46: robot 'm': field 'limits.speed' expected a positive number, got 0");
    CHECK(error("robot 'm' { model = 'raspimouse', active = 1 }") ==
          "s.lua:1:35: robot 'm': field 'active' expected true or false, got number");
    CHECK(error("behavior 'c' { script = 'robot_controller', config = { speed_x = print } }") ==
          "s.lua:1:56: behavior 'c': field 'config.speed_x' expected a number, a truth value, a text or an array of "
          "them, got function");
    CHECK(error("behavior 'c' { script = 'robot_controller', config = { a = { 1, 'x' } } }") ==
          "s.lua:1:56: behavior 'c': field 'config.a' expected an array of numbers, of truth values or of texts");
    CHECK(error("behavior 'c' { script = 'robot_controller', config = { a = { b = 1 } } }") ==
          "s.lua:1:56: behavior 'c': field 'config.a' expected an array, got a table with a field 'b'");
    CHECK(error("behavior 'c' { script = 'robot_controller', config = { a = -math.huge } }") ==
          "s.lua:1:56: behavior 'c': field 'config.a' expected a finite number, got -inf");
    CHECK(error("robot 'm' 'raspimouse'") == "s.lua:1: robot 'm': expected a table, got string");
}

TEST_CASE("a missing field is told with what belongs there", "[lua][system_file]") {
    CHECK(error("robot 'm' {}") ==
          "s.lua:1: robot 'm': field 'model' is missing: expected a robot's model, for example \"raspimouse\"");
    CHECK(error("behavior 'c' {}") ==
          "s.lua:1: behavior 'c': field 'script' is missing: expected a behaviour's file, for example "
          "\"robot_controller\"");
    CHECK(
        error("component 'c' {}") ==
        "s.lua:1: component 'c': field 'type' is missing: expected a native component's type, for example \"Camera\"");
    CHECK(error("arena { box { size = { 1, 1, 1 } } }") ==
          "s.lua:1: box: field 'at' is missing: expected { x, y, z } of the centre in metres");
    CHECK(error("arena { marker { at = { 1, 1, 1 } } }") ==
          "s.lua:1: marker: field 'id' is missing: expected a tag's number from 0 to 586");
}

TEST_CASE("things of an arena have a size", "[lua][system_file]") {
    CHECK(error("arena { box { at = { 0, 0, 0 }, size = { 1, 0, 1 } } }") ==
          "s.lua:1:45: box: field 'size[2]' expected a positive number, got 0");
    CHECK(error("arena { box { at = { 0, 0, 0 }, size = { 1, 1 } } }") ==
          "s.lua:1:33: box: field 'size' expected 3 numbers { x, y, z }, got 2");
    CHECK(error("arena { box { at = { 0, 0, 0 }, size = { 1, 1, 1e-7 } } }") ==
          "s.lua:1:33: box: field 'size' expected lengths of at least 0.0001 m");
    CHECK(error("arena { box { at = { 0, 0, 1e9 }, size = { 1, 1, 1 } } }") ==
          "s.lua:1:28: box: field 'at[3]' expected a number up to 1000000, got 1000000000");
    CHECK(error("arena { box { at = { 0, 0, 1, 2 }, size = { 1, 1, 1 } } }") ==
          "s.lua:1:15: box: field 'at' expected 3 numbers { x, y, z }, got 4");
    CHECK(error("arena { box { at = { x = 0, y = 0, w = 1 }, size = { 1, 1, 1 } } }") ==
          "s.lua:1:36: box: unknown field 'at.w': expected { x, y, z }");
    CHECK(error("arena { box { at = 'here', size = { 1, 1, 1 } } }") ==
          "s.lua:1:15: box: field 'at' expected { x, y, z }, got string");
    CHECK(error("arena { box { at = { 0, 0 }, size = { 1, 1, 1 }, mass = -1 } }") ==
          "s.lua:1:50: box: field 'mass' expected a number from 0 on, got -1");
    CHECK(error("arena { box { at = { 0, 0 }, size = { 1, 1, 1 }, color = 'yelow' } }") ==
          "s.lua:1:50: box: field 'color' expected \"#rrggbb\" or the name of a colour, got 'yelow' (did you mean "
          "'yellow'?)");
    CHECK(error("arena { box { at = { 0, 0 }, size = { 1, 1, 1 }, mass = 1, pitch = 0.1 } }") ==
          "s.lua:1:60: box: field 'pitch' is for a box without mass: a movable one stands level");
    CHECK(error("arena { wall { from = { 1, 1 }, to = { 1, 1 } } }") ==
          "s.lua:1:33: wall: 'from' and 'to' are the same place: expected a wall with a length");
    CHECK(error("arena { wall { from = { 1, 1, 0 }, to = { 1, 1 } } }") ==
          "s.lua:1:16: wall: field 'from' expected 2 numbers { x, y }, got 3");
    CHECK(error("arena { cylinder { at = { 0, 0 }, radius = -1, height = 1 } }") ==
          "s.lua:1:35: cylinder: field 'radius' expected a positive number, got -1");
    CHECK(error("arena { marker { id = 587, at = { 0, 0, 0 } } }") ==
          "s.lua:1:18: marker: field 'id' expected a whole number from 0 to 586, got 587");
    CHECK(error("arena { marker { id = 1.5, at = { 0, 0, 0 } } }") ==
          "s.lua:1:18: marker: field 'id' expected a whole number from 0 to 586, got 1.5");
    CHECK(error("arena { size = { 1, -1 } }") ==
          "s.lua:1:21: arena: field 'size[2]' expected a positive number, got -1");
    CHECK(error("arena { size = 4 }") == "s.lua:1:9: arena: field 'size' expected { x, y }, got number");
    CHECK(error("arena 'big'") == "s.lua:1: arena: expected a table, got string");
}

TEST_CASE("every thing is in the arena exactly once", "[lua][system_file]") {
    CHECK(error("\nbox { at = { 0, 0 }, size = { 1, 1, 1 } }") ==
          "s.lua:2: box: is not in the arena: write arena { box ... }");
    CHECK(error("local b = box { at = { 0, 0 }, size = { 1, 1, 1 } }\narena { b }\narena { b }") ==
          "s.lua:3: arena: the box of behaviors/systems/s.lua:1 is in the arena already");
    CHECK(error("arena { 5 }") ==
          "s.lua:1: arena: element 1 is no box, wall, cylinder, marker, floor or csv, but a number");
    CHECK(error("arena { { at = { 0, 0 } } }") ==
          "s.lua:1: arena: element 1 is no box, wall, cylinder, marker, floor or csv, but a table");
    CHECK(error("arena { size = { 1, 1 } }\narena { size = { 1, 1 } }") ==
          "s.lua:2:9: arena: field 'size' is set already, at behaviors/systems/s.lua:1");
    CHECK(error("arena { marker { id = 1, at = { 0, 0, 0 } },\n marker { id = 1, at = { 1, 0, 0 } } }") ==
          "s.lua:2: marker: the name 'marker_1' is taken by the marker of behaviors/systems/s.lua:1");
}

TEST_CASE("an unknown model or script is told with the nearest name and the places", "[lua][system_file]") {
    CHECK(error("robot 'm' { model = 'raspimous' }") ==
          "s.lua:1:13: robot 'm': there is no robot model 'raspimous' (did you mean 'raspimouse'?); looked for "
          "behaviors/systems/raspimous.lua, behaviors/raspimous.lua, engine/robots/raspimous.lua");
    CHECK(
        error("behavior 'c' {\n  script = 'robot_controler' }") ==
        "s.lua:2:3: behavior 'c': there is no script 'robot_controler' (did you mean 'robot_controller'?); looked for "
        "behaviors/systems/robot_controler.lua, behaviors/robot_controler.lua");
    CHECK_THAT(error("arena { csv 'no.csv' }"),
               Catch::StartsWith("s.lua:1: csv: there is no file 'no.csv'; looked for "));
    CHECK_THAT(error("arena { floor { image = 'no.png', size = { 1, 1 } } }"),
               Catch::StartsWith("s.lua:1:17: floor: there is no file 'no.png'; looked for "));
}

TEST_CASE("names are free identifiers", "[lua][system_file]") {
    CHECK(error("robot 'm' { model = 'raspimouse' }\nbehavior 'm' { script = 'robot_controller' }") ==
          "s.lua:2: behavior 'm': the name is taken by the robot of behaviors/systems/s.lua:1");
    CHECK(error("robot 'my mouse' { model = 'raspimouse' }") ==
          "s.lua:1: robot 'my mouse': a name consists of letters, digits and _, and does not begin with a digit");
    CHECK_THAT(error("robot '1st' {}"), Catch::Contains("does not begin with a digit"));
    CHECK_THAT(error("robot '' {}"), Catch::Contains("a name consists of letters"));
    CHECK(error("behavior 'step' {}") ==
          "s.lua:1: behavior 'step': 'step' is a word of Lua or of the console: choose another name");
    CHECK_THAT(error("behavior 'end' {}"), Catch::Contains("is a word of Lua"));
    CHECK(error("robot { model = 'raspimouse' }") ==
          "s.lua:1: robot: expected a name, got table: write robot \"NAME\" { ... }");
    CHECK(error("-- a name alone\nrobot 'm'") ==
          "s.lua:2: robot 'm': expected a table after the name: robot \"m\" { ... }");
    CHECK(error("robot('m', {}, 3)") == "s.lua:1: robot: expected at most 2 arguments, got 3");
}

TEST_CASE("a set is one of the sets", "[lua][system_file]") {
    CHECK(error("behavior 'c' { script = 'robot_controller', sets = { careful = {} }, set = 'carefull' }") ==
          "s.lua:1:70: behavior 'c': field 'set': there is no set 'carefull' in 'sets' (did you mean 'careful'?)");
    CHECK_THAT(error("behavior 'c' { script = 'robot_controller', set = 'fast' }"),
               Catch::Contains("there is no set 'fast'"));
    CHECK(error("behavior 'c' { script = 'robot_controller', sets = { careful = 3 } }") ==
          "s.lua:1:54: behavior 'c': field 'sets.careful' expected a table, got number");
    CHECK(error("behavior 'c' { script = 'robot_controller', sets = { careful = { x = {{}} } } }") ==
          "s.lua:1:66: behavior 'c': field 'sets.careful.x' expected an array of numbers, of truth values or of texts");
}

TEST_CASE("a connection names two ports, once", "[lua][system_file]") {
    CHECK(error("connect('mouse', 'controller.in')") == "s.lua:1: connect: expected \"name.port\", got 'mouse'");
    CHECK(error("connect('mouse.a', 'controller.in.x')") ==
          "s.lua:1: connect: expected \"name.port\", got 'controller.in.x'");
    CHECK(error("connect('mouse.', 'controller.in')") == "s.lua:1: connect: expected \"name.port\", got 'mouse.'");
    CHECK(error("connect('mouse.a')") == "s.lua:1: connect: expected \"name.port\", got nil");
    CHECK(error("connect(1, 2)") == "s.lua:1: connect: expected \"name.port\", got number");
    CHECK(error("connect()") == "s.lua:1: connect: expected an argument, got none");
    CHECK(error("connect('a.x', 'b.in')\nconnect('a.x', 'b.in')") ==
          "s.lua:2: connect: a.x is connected to b.in already, at behaviors/systems/s.lua:1");
    CHECK(system_of("connect('a.x', 'b.in') connect('a.x', 'c.in')").connections.size() == 2);
}

TEST_CASE("a component is carried by a robot that is there", "[lua][system_file]") {
    CHECK(error("robot 'mouse' { model = 'raspimouse' }\ncomponent 'eye' { type = 'Camera', on = 'mous' }") ==
          "s.lua:2: component 'eye': field 'on' names no robot: there is none 'mous' (did you mean 'mouse'?)");
}

TEST_CASE("globals that nobody knows are refused before anything runs", "[lua][system_file]") {
    CHECK_THAT(error("connect('a.x', 'b.y')\nif false then\n  robott 'm' {}\nend"), Catch::StartsWith("s.lua:3:3: "));
    CHECK_THAT(error("robott 'm' {}"), Catch::Contains("robot"));
    CHECK_THAT(error("count = 3"), Catch::StartsWith("s.lua:1:1: "));
    CHECK_THAT(error("io.open('x')"), Catch::Contains("'io'"));
    CHECK_THAT(error("os.exit(1)"), Catch::Contains("'os'"));
    CHECK_THAT(error("robot = nil"), Catch::StartsWith("s.lua:1:1: "));
}

TEST_CASE("what is no Lua, runs into an error or never ends is one message", "[lua][system_file]") {
    CHECK_THAT(error("arena {\n  box {\n"), Catch::StartsWith("s.lua:"));
    CHECK_THAT(error("local a = nil\nlocal b = a.x"), Catch::StartsWith("s.lua:2: attempt to index a nil value"));
    CHECK(error("error('no arena today')") == "s.lua:1: no arena today");
    CHECK_THAT(error("\x1bLua"), Catch::Contains("bytecode"));
    CHECK(error("") == "s.lua: the file says nothing: expected robot, behavior, arena, connect ...");
    const auto endless = read("while true do end", {.seconds = 0.05});
    REQUIRE_FALSE(endless.has_value());
    CHECK(endless.error().kind == Error::Kind::out_of_time);
    CHECK(endless.error().place.line == 1);
    CHECK_THAT(error("local t = {} t.t = t robot('m', t)"),
               Catch::Contains("nested too deeply, or a table is within itself"));
    CHECK_THAT(error("local t = {} for i = 1, 1e9 do t[i] = 'x' .. i end"), Catch::Contains("memory"));
}

TEST_CASE("whatever a file says, a message is one short line", "[lua][system_file]") {
    CHECK(error("error('a\\nb\\27[2J\\0')") == "s.lua:1: a b?[2J?");
    CHECK_THAT(error("robot('a\\nb', {})"), Catch::StartsWith("s.lua:1: robot 'a b': a name consists"));
    CHECK(error("behavior('c', { script = ('x'):rep(100000) })").size() < 1100);
    CHECK(error("local " + std::string(5000, 'x') + " = = 1").size() < 1100);
}

TEST_CASE("a name never stands for a device", "[lua][system_file]") {
    CHECK_THAT(error("arena { csv '/dev/zero' }"), Catch::StartsWith("s.lua:1: csv: there is no file '/dev/zero'"));
}

TEST_CASE("an error that the file catches is an error all the same", "[lua][system_file]") {
    CHECK(error("pcall(rate, -1)\nrate(50)") == "s.lua:1: rate: expected a positive number of ticks a second, got -1");
}

TEST_CASE("a table that changes after a call changes nothing", "[lua][system_file]") {
    const auto spec =
        system_of("local t = { script = 'robot_controller', rate = 10 } behavior('a', t) t.rate = 20 behavior('b', t)");
    CHECK(entry<BehaviorEntry>(spec, 0).rate == 10);
    CHECK(entry<BehaviorEntry>(spec, 1).rate == 20);
}

TEST_CASE("a system requires modules of the project, which use its words too", "[lua][system_file]") {
    const Scratch scratch;
    scratch.write("behaviors/lib/room.lua",
                  "local room = {}\nfunction room.make(n)\n  for i = 1, n do\n"
                  "    arena { box { at = { i, 0 }, size = { 0.1, 0.1, 0.1 } } }\n  end\nend\nreturn room\n");
    scratch.write("behaviors/twice.lua", "seed(7)\n");
    scratch.write("behaviors/a.lua", "require 'b'");
    scratch.write("behaviors/b.lua", "require 'a'");
    scratch.write("behaviors/broken.lua", "local x =\n");
    scratch.write("behaviors/slip.lua", "\nlocal y = taget\n");
    const Project project = Project::of(scratch.path("behaviors/systems/s.lua"));
    const auto read_here = [&](std::string_view text) {
        return read_system_text(text, scratch.path("behaviors/systems/s.lua").string(), project);
    };
    const auto spec = read_here("require('lib.room').make(3) require 'twice' assert(require 'twice' == true)");
    INFO((spec ? std::string() : describe(spec.error())));
    REQUIRE(spec.has_value());
    CHECK(spec->arena.boxes.size() == 3);
    CHECK(spec->arena.boxes[0].place == Place{scratch.path("behaviors/lib/room.lua").string(), 4});
    CHECK(spec->seed == 7);
    CHECK(spec->files.size() == 3);
    const auto message = [&](std::string_view text) {
        const auto bad = read_here(text);
        return bad ? "no error" : describe(bad.error());
    };
    CHECK_THAT(message("require 'a'"), Catch::Contains("b.lua:1: require: module 'a' requires itself"));
    CHECK_THAT(
        message("\nrequire 'lib.rom'"),
        Catch::Contains("s.lua:2: require: there is no module 'lib.rom' (did you mean 'lib.room'?); looked for "));
    CHECK_THAT(message("require 'broken'"), Catch::Contains("broken.lua:"));
    CHECK_THAT(message("require 'slip'"), Catch::Contains("slip.lua:2:11: "));
    CHECK_THAT(message("require(5)"), Catch::Contains("s.lua:1: require: expected a module's name, got number"));
}

TEST_CASE("what a system file prints reaches whoever wants it", "[lua][system_file]") {
    std::string printed;
    REQUIRE(read("print('hello', 1) seed(1)", {.print = [&](std::string_view line) { printed += line; }}).has_value());
    CHECK(printed == "hello\t1");
}

TEST_CASE("a missing system file is one plain message", "[lua][system_file]") {
    const Project project = Project::of("nothing.lua");
    CHECK(describe(read_system_file("nothing.lua", project).error()) == "nothing.lua: there is no such file");
    CHECK(describe(read_system_file("behaviors", project).error()) == "behaviors: is a folder, expected a file");
}

TEST_CASE("every system that is shipped can be read", "[lua][system_file]") {
    std::size_t count = 0;
    for (const auto& file : std::filesystem::directory_iterator(root / "behaviors/systems")) {
        const Project project = Project::of(file.path(), {root});
        const auto spec = read_system_file(file.path(), project);
        INFO((spec ? file.path().string() : describe(spec.error())));
        CHECK(spec.has_value());
        ++count;
    }
    CHECK(count >= 3);
}

TEST_CASE("a check of a system file tells every unknown global", "[lua][system_file]") {
    const Project project = Project::of(root / "behaviors/systems/s.lua", {root});
    CHECK(check_system_text("seed(1)", "s.lua", project).empty());
    const auto errors = check_system_text("sead(1)\nif false then\n  robott 'm' {}\nend", "s.lua", project);
    REQUIRE(errors.size() == 2);
    CHECK(errors[0].place == Place{"s.lua", 1, 1});
    CHECK(errors[1].place == Place{"s.lua", 3, 3});
    CHECK(check_system_text("seed(-1) seed(-1)", "s.lua", project).size() == 1);
    CHECK(check_system_text("", "s.lua", project).size() == 1);
    CHECK(check_system_text("rate(60)", "s.lua", project).size() == 1);
}
