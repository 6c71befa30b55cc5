// System files: what they may say.
#include <catch2/catch.hpp>
#include <numbers>

#include "engine/values/value_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/lua/system_reader.hpp"

using namespace nezumi;
using namespace nezumi::system_files;

TEST_CASE("the tutorial's system is read completely", "[lua][system_file]") {
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

TEST_CASE("a robot has a model, pose, limits, driver and the option active", "[lua][system_file]") {
    const auto spec = system_of(R"(
        robot("m", { model = "raspimouse.lua", pose = { x = 1, y = -2.5, heading = math.pi }, limits = { speed = 2.0, yaw_rate = 8,
              acceleration = 1, yaw_acceleration = 3 }, backend = "raspimouse", active = false }))");
    const auto& m = entry<RobotEntry>(spec, 0);
    CHECK(m.model == "raspimouse.lua");
    CHECK(spec.models.contains("raspimouse.lua"));
    CHECK(m.pose == Pose2D{{1, -2.5}, std::numbers::pi});
    CHECK(m.limits.speed == 2.0);
    CHECK(m.limits.yaw_rate == 8.0);
    CHECK(m.limits.acceleration == 1.0);
    CHECK(m.limits.yaw_acceleration == 3.0);
    CHECK(m.backend == "raspimouse");
    CHECK_FALSE(m.active);
    CHECK_FALSE(entry<RobotEntry>(system_of("robot 'm' { model = 'raspimouse', limits = { speed = 1 } }"), 0)
                    .limits.yaw_rate.has_value());
}

TEST_CASE("a behaviour has parameters of every type, parameter sets and a rate", "[lua][system_file]") {
    const auto spec = system_of(R"(behavior "c" { script = "robot_controller.lua", rate = 50, active = false,
        config = { a = 1, b = 1.0, c = true, d = "text", e = { 1, 2 }, f = { 1, 2.5 }, g = { "x" }, h = { true, false }, i = {} },
        sets = { careful = { a = 2 }, fast = { b = 3.5 } }, set = "careful" })");
    const auto& c = entry<BehaviorEntry>(spec, 0);
    CHECK(c.rate == 50);
    CHECK_FALSE(c.active);
    CHECK(c.path == "behaviors/robot_controller.lua");
    CHECK(c.config.at("a") == Value{std::int64_t{1}});
    CHECK(c.config.at("b") == Value{1.0});
    CHECK(c.config.at("c") == Value{true});
    CHECK(c.config.at("d") == Value{std::string("text")});
    CHECK(c.config.at("e") == Value{std::vector<std::int64_t>{1, 2}});
    CHECK(c.config.at("f") == Value{std::vector<double>{1, 2.5}});
    CHECK(c.config.at("g") == Value{std::vector<std::string>{"x"}});
    CHECK(c.config.at("h") == Value{std::vector<bool>{true, false}});
    CHECK(lua_text(c.config.at("i")) == "{}");
    CHECK(c.sets.at("careful") == ParameterValues{{"a", std::int64_t{2}}});
    CHECK(c.sets.at("fast") == ParameterValues{{"b", 3.5}});
    CHECK(c.set == "careful");
}

TEST_CASE("the locations of a behaviour's values are stored", "[lua][system_file]") {
    const auto spec = system_of(
        "behavior 'c' {\n  script = 'robot_controller',\n  config = {\n    a = 1,\n  },\n"
        "  sets = { fast = {\n b = 2 } },\n}");
    const FieldPlaces& places = entry<BehaviorEntry>(spec, 0).places;
    CHECK(places.size() == 2);
    CHECK(places.at("config.a") == Place{"behaviors/systems/s.lua", 4, 5});
    CHECK(places.at("sets.fast.b") == Place{"behaviors/systems/s.lua", 7, 2});
}

TEST_CASE("a native component has a type, a position and a robot", "[lua][system_file]") {
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

TEST_CASE("an arena contains boxes, walls, cylinders and markers, and has a size", "[lua][system_file]") {
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

TEST_CASE("an arena has a border by default", "[lua][system_file]") {
    CHECK(system_of("arena { size = { 1, 1 } }").arena.border);
    const auto spec = system_of("arena { size = { 1, 1 }, border = { height = 0.3, thickness = 0.05 } }");
    CHECK(spec.arena.border == BorderSpec{.thickness = 0.05, .height = 0.3});
    CHECK_FALSE(system_of("arena { box { at = { 0, 0 }, size = { 1, 1, 1 } } }").arena.size.has_value());
    CHECK(system_of("arena { box { at = { 0, 0 }, size = { 1, 1, 1 }, pitch = -0.2 } }").arena.boxes[0].pitch == -0.2);
}

TEST_CASE("a maze is drawn, or generated from a seed", "[lua][system_file]") {
    const auto drawn = system_of(R"(
        arena { maze {
          rows = { "+--+", "|  |", "+--+" }, cell = 0.2, at = { 1, 2 },
        } })");
    REQUIRE(drawn.arena.boxes.size() == 4);
    CHECK(drawn.arena.boxes[0].at == Point3D{1, 2.1, 0.025});
    CHECK(drawn.arena.boxes[0].place.line == 2);
    const auto boxes = [](const std::string& plan) {
        return system_of("arena { maze { generate = " + plan + " } }").arena.boxes.size();
    };
    CHECK(boxes("{ columns = 1, rows = 1 }") == 4);
    CHECK(boxes("{}") == boxes("{ columns = 8, rows = 8, seed = 1 }"));
    CHECK(boxes("{ columns = 4, rows = 4, seed = 2 }") > 6);
}

TEST_CASE("objects of an arena may come from loops, functions and lists", "[lua][system_file]") {
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
    std::string said;
    REQUIRE(read_system_text("arena { csv 'map.csv' }", scratch.path("s.lua").string(), project,
                             {.print = [&](std::string_view line) { said += line; }}));
    CHECK(said == scratch.path("behaviors/map.csv").string() + ": 1 box");
    scratch.write("behaviors/map.csv", "x,y,z,lx,ly,lz,yaw\n\n1,2,3,abc,5,6,7\n");
    const auto bad = read_system_text("arena { csv 'map.csv' }", "s.lua", project);
    REQUIRE_FALSE(bad.has_value());
    CHECK(bad.error().place.line == 3);
    CHECK(bad.error().message == "column 'lx': expected a positive number, got 'abc'");
}

TEST_CASE("a loop makes many robots", "[lua][system_file]") {
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
    CHECK(entry<BehaviorEntry>(spec, 1).config.at("speed_x") == Value{0.01});
    CHECK(entry<BehaviorEntry>(spec, 39).config.at("speed_x") == Value{0.2});
    CHECK(entry<BehaviorEntry>(spec, 39).place.line == 6);
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

TEST_CASE("the output of a system file is passed to the caller", "[lua][system_file]") {
    std::string printed;
    REQUIRE(read("print('hello', 1) seed(1)", {.print = [&](std::string_view line) { printed += line; }}).has_value());
    CHECK(printed == "hello\t1");
}

TEST_CASE("every shipped system can be read", "[lua][system_file]") {
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

TEST_CASE("a line has points", "[lua][system_file]") {
    const auto spec = system_of(
        "arena { size = { 2, 2 }, line { points = { { 0, 0 }, { 0.5, 0.25 }, { 1, 1 } } },\n"
        "line { points = { { -1, -1 }, { 0, 0 } }, width = 0.05, color = 'red' } }");
    REQUIRE(spec.arena.lines.size() == 2);
    CHECK(spec.arena.lines[0].points == std::vector<Point2D>{{0, 0}, {0.5, 0.25}, {1, 1}});
    CHECK(spec.arena.lines[0].width == 0.02);
    CHECK(spec.arena.lines[0].color == "#1c1c1c");
    CHECK(spec.arena.lines[1].width == 0.05);
    CHECK(spec.arena.lines[1].color == "#d6453d");
    CHECK(spec.arena.lines[1].place.line == 2);
}

TEST_CASE("occupied pixels of a map of ROS become boxes of the arena", "[lua][system_file]") {
    const Scratch scratch;
    scratch.write("behaviors/rooms/map.yaml", "image: map.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n");
    scratch.write("behaviors/rooms/map.pgm", std::string("P5\n2 1\n255\n") + '\0' + '\xfe');
    const Project project = Project::of(scratch.path("s.lua"));
    const auto read = [&](const std::string& text) {
        return read_system_text(text, scratch.path("s.lua").string(), project);
    };
    const auto spec = read("arena { map 'rooms/map.yaml' }");
    INFO((spec ? std::string() : describe(spec.error())));
    REQUIRE(spec.has_value());
    REQUIRE(spec->arena.boxes.size() == 1);
    CHECK(spec->arena.boxes[0].at == Point3D{0.25, 0.25, 0.05});
    CHECK(spec->files.size() == 3);  // a change of any of them makes the system anew
    CHECK(read("arena { map 'rooms/map.yml' }").error().message.find("map: ") == 0);
    CHECK(read("arena { map = 'rooms/map.yaml' }").error().message ==
          "arena: unknown field 'map': write map \"map.yaml\", without =");
    scratch.write("behaviors/rooms/map.yaml", "image: gone.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n");
    CHECK(read("arena { map 'rooms/map.yaml' }").error().message.find("gone.pgm") != std::string::npos);
    CHECK(read("arena { map 'rooms/map.yaml' }").error().place ==
          Place{scratch.path("behaviors/rooms/map.yaml").string(), 1});
    scratch.write("behaviors/rooms/map.yaml", "image: map.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n");
    const auto high = read("arena { map { 'rooms/map.yaml', height = 0.4 } }");
    REQUIRE(high.has_value());
    CHECK(high->arena.boxes.at(0).size.z == 0.4);
    CHECK(high->arena.boxes.at(0).at.z == 0.2);
}

TEST_CASE("the limits of a box also apply to boxes of maps", "[lua][system_file]") {
    const Scratch scratch;
    scratch.write("behaviors/any.lua", "");
    const Project project = Project::of(scratch.path("s.lua"));
    const auto error = [&](const std::string& text) {
        const auto spec = read_system_text(text, scratch.path("s.lua").string(), project);
        if (spec) return std::string("no error");
        std::string said = describe(spec.error());
        return said.substr(said.rfind('/') + 1);
    };
    scratch.write("behaviors/map.csv", "x,y,z,lx,ly,lz,yaw\n0,0,0,1,1,1,0\n0,0,0,1,1e-300,1,0\n");
    CHECK(error("arena { csv 'map.csv' }") == "map.csv:3: box: field 'size.y' expected at least 0.0001 m, got 1e-300");
    scratch.write("behaviors/map.yaml", "image: map.pgm\nresolution: 1000\norigin: [999999, 0, 0]\n");
    scratch.write("behaviors/map.pgm", std::string("P5\n3 1\n255\n") + "\xfe\xfe" + '\0');
    CHECK(error("\narena { map 'map.yaml' }") ==
          "s.lua:2: box: field 'at.x' expected a number up to 1000000, got 1002499");
}
