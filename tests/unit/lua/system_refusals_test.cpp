// System files with a slip: what is said, and where.
#include <catch2/catch.hpp>

#include "tests/unit/lua/system_reader.hpp"

using namespace nezumi;
using namespace nezumi::system_files;

TEST_CASE("seed, rate and the physics step are set once", "[lua][system_file]") {
    const auto spec = system_of("seed(42) rate(50) physics { step = 0.01 }");
    CHECK(spec.seed == 42);
    CHECK(spec.rate == 50);
    CHECK(spec.rate_place.line == 1);
    CHECK(spec.physics_step == 0.01);
    CHECK(system_error("seed(1)\nseed(1)") == "s.lua:2: seed: is set already, at behaviors/systems/s.lua:1");
    CHECK(system_error("rate(50)\nrate(50)") == "s.lua:2: rate: is set already, at behaviors/systems/s.lua:1");
    CHECK(system_error("physics { step = 0.01 }\nphysics { step = 0.01 }") ==
          "s.lua:2: physics: is set already, at behaviors/systems/s.lua:1");
    CHECK(system_error("seed(-1)") == "s.lua:1: seed: expected a whole number from 0 on, got -1");
    CHECK(system_error("seed(1.5)") == "s.lua:1: seed: expected a whole number from 0 on, got 1.5");
    CHECK(system_of("seed(1e3)").seed == 1000);
    CHECK(system_of("seed(2^62)").seed == std::uint64_t{1} << 62);
    CHECK(system_error("seed 'x'") == "s.lua:1: seed: expected a whole number from 0 on, got string");
    CHECK(system_error("rate(0)") == "s.lua:1: rate: expected a positive number of ticks a second, got 0");
    CHECK(system_error("rate(0/0)") == "s.lua:1: rate: expected a positive number of ticks a second, got nan");
    CHECK(system_error("rate {}") == "s.lua:1: rate: expected a positive number of ticks a second, got table");
    CHECK(system_error("rate()") == "s.lua:1: rate: expected an argument, got none");
    CHECK(system_error("physics { step = -1 }") ==
          "s.lua:1:11: physics: field 'step' expected a positive number, got -1");
    CHECK(system_error("physics { stepp = 1 }") == "s.lua:1:11: physics: unknown field 'stepp' (did you mean 'step'?)");
    CHECK(system_error("physics { step = 1e-300 } rate(1e300)") ==
          "s.lua:1:11: physics: field 'step' expected at least 1e-06 s, got 1e-300");
    // A component that is due less often than that would be divided by nothing.
    CHECK(system_error("behavior 'b' { script = 'robot_controller', rate = 1e-7 }") ==
          "s.lua:1:45: behavior 'b': field 'rate' expected at least 1e-06 Hz, got 1e-07");
    CHECK(system_error("physics {}") ==
          "s.lua:1: physics: field 'step' is missing: expected a positive number in s: of time that the physics "
          "advances at once; a tick is a whole number of them");
}

TEST_CASE("a message of a missing or wrong field says all that it may be, and no more", "[lua][system_file]") {
    CHECK(system_error("arena { size = { 2, 2 }, cylinder { at = { 1, 1 }, radius = 0.1 } }") ==
          "s.lua:1: cylinder: field 'height' is missing: expected a positive number in m");
    CHECK(system_error("arena { size = { 2, 2 }, border = 5 }") ==
          "s.lua:1:26: arena: field 'border' expected true, false or { thickness =, height = }, got number");
}

TEST_CASE("a tick is a whole number of physics steps", "[lua][system_file]") {
    CHECK(system_error("-- tick\nrate(60)") ==
          "s.lua:2: rate: a tick of 60 Hz is no whole number of physics steps of 0.005 s; the nearest rates are 50 or "
          "66.66666666666667 Hz");
    CHECK_THAT(system_error("physics { step = 0.003 }"),
               Catch::StartsWith("s.lua:1: rate: a tick of 100 Hz is no whole number"));
    CHECK(system_of("rate(200)").rate == 200);
}

TEST_CASE("a component's rate is at most the tick's", "[lua][system_file]") {
    CHECK(system_error("behavior 'c' { script = 'robot_controller',\n rate = 200 }") ==
          "s.lua:2:2: behavior 'c': a rate of 200 Hz is above the tick's 100 Hz: lower it, or raise the tick with "
          "rate(...)");
    CHECK(system_error("component 'c' { type = 'Joystick', rate = 101 }").find("component 'c': a rate of 101 Hz") !=
          std::string::npos);
    CHECK(
        entry<BehaviorEntry>(system_of("behavior 'c' { script = 'robot_controller', rate = 200 } rate(200)"), 0).rate ==
        200);
    CHECK(system_error("behavior 'c' { script = 'robot_controller', rate = 0 }") ==
          "s.lua:1:45: behavior 'c': field 'rate' expected a positive number, got 0");
}

TEST_CASE("an unknown field is told with the nearest one, at its place", "[lua][system_file]") {
    CHECK(system_error("robot 'm' {\n  modell = 'raspimouse' }") ==
          "s.lua:2:3: robot 'm': unknown field 'modell' (did you mean 'model'?)");
    CHECK(system_error("robot 'm' { model = 'raspimouse',\n  pose = {\n x = 1,\n heding = 2 } }") ==
          "s.lua:4:2: robot 'm': unknown field 'pose.heding' (did you mean 'heading'?)");
    CHECK(system_error("robot('m', { model = 'raspimouse', limits = { sped = 2 } })") ==
          "s.lua:1:47: robot 'm': unknown field 'limits.sped' (did you mean 'speed'?)");
    CHECK(system_error("robot 'e' { model = 'ev3', config = { medium_motor_speed = 2 } }") ==
          "s.lua:1:28: robot 'e': unknown field 'config': write fields of its description, as in actuators = { "
          "medium_motor = { speed = 2 } }");
    CHECK(system_error("behavior 'c' { script = 'robot_controller', speed_x = 1 }") ==
          "s.lua:1:45: behavior 'c': unknown field 'speed_x': expected script, config, sets, set, rate, active");
    CHECK(system_error("behavior 'c' { 'robot_controller' }") ==
          "s.lua:1:16: behavior 'c': unknown field '[1]': expected script, config, sets, set, rate, active");
    CHECK(system_error("component 'c' { typ = 'Camera' }") ==
          "s.lua:1:17: component 'c': unknown field 'typ' (did you mean 'type'?)");
    CHECK(system_error("arena {\n box { at = { 1, 0, 0 }, sise = { 1, 1, 1 } } }") ==
          "s.lua:2:26: box: unknown field 'sise' (did you mean 'size'?)");
    CHECK(system_error("arena { siz = { 1, 1 } }") == "s.lua:1:9: arena: unknown field 'siz' (did you mean 'size'?)");
    CHECK(system_error("arena { box = { at = { 0, 0 }, size = { 1, 1, 1 } } }") ==
          "s.lua:1:9: arena: unknown field 'box': write box { ... }, without =");
    CHECK(system_error("arena { csv = 'map.csv' }") ==
          "s.lua:1:9: arena: unknown field 'csv': write csv \"map.csv\", without =");
}

TEST_CASE("a value of the wrong kind is told with its field", "[lua][system_file]") {
    CHECK(system_error("robot 'm' { model = 5 }") ==
          "s.lua:1:13: robot 'm': field 'model' expected a text, got number");
    CHECK(system_error("robot 'm' { model = 'raspimouse', pose = { x = '1' } }") ==
          "s.lua:1:44: robot 'm': field 'pose.x' expected a number, got string");
    CHECK(system_error("robot 'm' { model = 'raspimouse', pose = { heading = 0/0 } }") ==
          "s.lua:1:44: robot 'm': field 'pose.heading' expected a finite number, got nan");
    CHECK(system_error("robot 'm' { model = 'raspimouse', pose = { y = math.huge } }") ==
          "s.lua:1:44: robot 'm': field 'pose.y' expected a finite number, got inf");
    CHECK(system_error("robot 'm' { model = 'raspimouse', pose = 3 }") ==
          "s.lua:1:35: robot 'm': field 'pose' expected a table, got number");
    CHECK(system_error("robot 'm' { model = 'raspimouse', limits = { speed = 0 } }") ==
          "s.lua:1:46: robot 'm': field 'limits.speed' expected a positive number, got 0");
    CHECK(system_error("robot 'm' { model = 'raspimouse', active = 1 }") ==
          "s.lua:1:35: robot 'm': field 'active' expected true or false, got number");
    CHECK(system_error("behavior 'c' { script = 'robot_controller', config = { speed_x = print } }") ==
          "s.lua:1:56: behavior 'c': field 'config.speed_x' expected a number, a truth value, a text or an array of "
          "them, got function");
    CHECK(system_error("behavior 'c' { script = 'robot_controller', config = { a = { 1, 'x' } } }") ==
          "s.lua:1:56: behavior 'c': field 'config.a' expected an array of numbers, of truth values or of texts");
    CHECK(system_error("behavior 'c' { script = 'robot_controller', config = { a = { b = 1 } } }") ==
          "s.lua:1:56: behavior 'c': field 'config.a' expected an array, got a table with a field 'b'");
    CHECK(system_error("behavior 'c' { script = 'robot_controller', config = { a = -math.huge } }") ==
          "s.lua:1:56: behavior 'c': field 'config.a' expected a finite number, got -inf");
    CHECK(system_error("robot 'm' 'raspimouse'") == "s.lua:1: robot 'm': expected a table, got string");
}

TEST_CASE("a missing field is told with what belongs there", "[lua][system_file]") {
    CHECK(system_error("robot 'm' {}") ==
          "s.lua:1: robot 'm': field 'model' is missing: expected a text: a robot's file, for example \"raspimouse\"");
    CHECK(system_error("behavior 'c' {}") ==
          "s.lua:1: behavior 'c': field 'script' is missing: expected a text: a behaviour's file, for example "
          "\"robot_controller\"");
    CHECK(system_error("component 'c' {}") ==
          "s.lua:1: component 'c': field 'type' is missing: expected a text: a native component's type, for example "
          "\"Camera\"");
    CHECK(system_error("arena { box { size = { 1, 1, 1 } } }") ==
          "s.lua:1: box: field 'at' is missing: expected { x, y, z } in m: centre; without z it stands on the "
          "floor");
    CHECK(system_error("arena { marker { at = { 1, 1, 1 } } }") ==
          "s.lua:1: marker: field 'id' is missing: expected a whole number from 0 to 586: the tag's number");
}

TEST_CASE("a maze lies within the arena", "[lua][system_file]") {
    CHECK(system_error("arena { size = { 1, 1 }, maze { generate = { columns = 4, rows = 2 } } }") ==
          "s.lua:1: maze: it reaches from { -0.096, -0.096 } to { 0.636, 0.276 }, out of the arena of 1 x 1 m: move it "
          "by 'at', or make the arena larger");
    CHECK(
        system_error(
            "arena { size = { 0.72, 0.36 }, maze { generate = { columns = 4, rows = 2 }, at = { -0.27, -0.09 } } }") ==
        "no error");
    CHECK(system_error("arena { maze { generate = { columns = 4, rows = 2 } } }") == "no error");
}

TEST_CASE("things of an arena have a size", "[lua][system_file]") {
    CHECK(system_error("arena { box { at = { 0, 0, 0 }, size = { 1, 0, 1 } } }") ==
          "s.lua:1:45: box: field 'size[2]' expected a positive number, got 0");
    CHECK(system_error("arena { box { at = { 0, 0, 0 }, size = { 1, 1 } } }") ==
          "s.lua:1:33: box: field 'size' expected 3 numbers { x, y, z }, got 2");
    CHECK(system_error("arena { box { at = { 0, 0, 0 }, size = { 1, 1, 1e-7 } } }") ==
          "s.lua:1:33: box: field 'size' expected lengths of at least 0.0001 m");
    CHECK(system_error("arena { box { at = { 0, 0, 1e9 }, size = { 1, 1, 1 } } }") ==
          "s.lua:1:28: box: field 'at[3]' expected a number up to 1000000, got 1000000000");
    CHECK(system_error("arena { box { at = { 0, 0, 1, 2 }, size = { 1, 1, 1 } } }") ==
          "s.lua:1:15: box: field 'at' expected 3 numbers { x, y, z }, got 4");
    CHECK(system_error("arena { box { at = { x = 0, y = 0, w = 1 }, size = { 1, 1, 1 } } }") ==
          "s.lua:1:36: box: unknown field 'at.w': expected { x, y, z }");
    CHECK(system_error("arena { box { at = 'here', size = { 1, 1, 1 } } }") ==
          "s.lua:1:15: box: field 'at' expected { x, y, z }, got string");
    CHECK(system_error("arena { box { at = { 0, 0 }, size = { 1, 1, 1 }, mass = -1 } }") ==
          "s.lua:1:50: box: field 'mass' expected a number from 0 on, got -1");
    CHECK(system_error("arena { box { at = { 0, 0 }, size = { 1, 1, 1 }, color = 'yelow' } }") ==
          "s.lua:1:50: box: field 'color' expected \"#rrggbb\" or the name of a colour, got 'yelow' (did you mean "
          "'yellow'?)");
    CHECK(system_error("arena { box { at = { 0, 0 }, size = { 1, 1, 1 }, mass = 1, pitch = 0.1 } }") ==
          "s.lua:1:60: box: field 'pitch' is for a box without mass: a movable one stands level");
    CHECK(system_error("arena { wall { from = { 1, 1 }, to = { 1, 1 } } }") ==
          "s.lua:1:33: wall: 'from' and 'to' are the same place: expected a wall with a length");
    CHECK(system_error("arena { wall { from = { 1, 1, 0 }, to = { 1, 1 } } }") ==
          "s.lua:1:16: wall: field 'from' expected 2 numbers { x, y }, got 3");
    CHECK(system_error("arena { cylinder { at = { 0, 0 }, radius = -1, height = 1 } }") ==
          "s.lua:1:35: cylinder: field 'radius' expected a positive number, got -1");
    CHECK(system_error("arena { maze {} }") ==
          "s.lua:1: maze: field 'rows' is missing: expected a drawing, or generate = { columns =, rows =, seed = }");
    CHECK(system_error("arena { maze { rows = 'x' } }") ==
          "s.lua:1:16: maze: field 'rows' expected a list of texts, got string");
    CHECK(system_error("arena { maze { rows = { '+--+', 5 } } }") ==
          "s.lua:1:33: maze: field 'rows[2]' expected a text, got number");
    CHECK(system_error("arena { maze { rows = { '+--+', '|  |' } } }") ==
          "s.lua:1:16: maze: field 'rows' expected 2 rows for each cell and one more, for 1 to 64 cells, got 2 rows");
    CHECK(system_error("arena { maze { rows = { '+--+', '|  |', '+-++' } } }") ==
          "s.lua:1:41: maze: field 'rows[3]' expected \"--\" or blanks from sign 2 on, got \"-+\"");
    CHECK(system_error("arena { maze { rows = { '+--+', '|  |', '+--+' }, generate = {} } }") ==
          "s.lua:1:51: maze: field 'generate' is for a maze without 'rows'");
    CHECK(system_error("arena { maze { generate = { columns = 65 } } }") ==
          "s.lua:1:29: maze: field 'generate.columns' expected a whole number from 1 to 64, got 65");
    CHECK(system_error("arena { maze { generate = {}, cell = 0.01 } }").find("field 'cell'") != std::string::npos);
    CHECK(system_error("arena { marker { id = 587, at = { 0, 0, 0 } } }") ==
          "s.lua:1:18: marker: field 'id' expected a whole number from 0 to 586, got 587");
    CHECK(system_error("arena { marker { id = 1, name = 'end', at = { 0, 0, 0 } } }") ==
          "s.lua:1:26: marker: field 'name' expected letters, digits and _, not beginning with a digit, and no keyword "
          "of Lua, got 'end'");
    CHECK(system_error("arena { marker { id = 1.5, at = { 0, 0, 0 } } }") ==
          "s.lua:1:18: marker: field 'id' expected a whole number from 0 to 586, got 1.5");
    CHECK(system_error("arena { size = { 1, -1 } }") ==
          "s.lua:1:21: arena: field 'size[2]' expected a positive number, got -1");
    CHECK(system_error("arena { size = 4 }") == "s.lua:1:9: arena: field 'size' expected { x, y }, got number");
    CHECK(system_error("arena 'big'") == "s.lua:1: arena: expected a table, got string");
}

TEST_CASE("every thing is in the arena exactly once", "[lua][system_file]") {
    CHECK(system_error("\nbox { at = { 0, 0 }, size = { 1, 1, 1 } }") ==
          "s.lua:2: box: is not in the arena: write arena { box ... }");
    CHECK(system_error("local b = box { at = { 0, 0 }, size = { 1, 1, 1 } }\narena { b }\narena { b }") ==
          "s.lua:3: arena: the box of behaviors/systems/s.lua:1 is in the arena already");
    CHECK(system_error("arena { 5 }") ==
          "s.lua:1: arena: element 1 is no box, wall, cylinder, marker, maze, floor, line, csv or map, but a number");
    CHECK(system_error("arena { { at = { 0, 0 } } }") ==
          "s.lua:1: arena: element 1 is no box, wall, cylinder, marker, maze, floor, line, csv or map, but a table");
    CHECK(system_error("arena { size = { 1, 1 } }\narena { size = { 1, 1 } }") ==
          "s.lua:2:9: arena: field 'size' is set already, at behaviors/systems/s.lua:1");
    CHECK(system_error(
              "arena { marker { name = 'c', id = 1, at = { 0, 0, 0 } } }\nbehavior 'c' { script = 'robot_controller' "
              "}") == "s.lua:1: marker 'c': the name is taken by the behavior of behaviors/systems/s.lua:2");
    CHECK(system_error("arena { marker { id = 1, at = { 0, 0, 0 } },\n marker { id = 1, at = { 1, 0, 0 } } }") ==
          "s.lua:2: marker: the name 'marker_1' is taken by the marker of behaviors/systems/s.lua:1");
}

TEST_CASE("an unknown model or script is told with the nearest name and the places", "[lua][system_file]") {
    CHECK(system_error("robot 'm' { model = 'raspimous' }") ==
          "s.lua:1:13: robot 'm': there is no robot model 'raspimous' (did you mean 'raspimouse'?); looked for "
          "behaviors/systems/raspimous.lua, behaviors/raspimous.lua, engine/robots/raspimous.lua");
    CHECK(
        system_error("behavior 'c' {\n  script = 'robot_controler' }") ==
        "s.lua:2:3: behavior 'c': there is no script 'robot_controler' (did you mean 'robot_controller'?); looked for "
        "behaviors/systems/robot_controler.lua, behaviors/robot_controler.lua");
    CHECK_THAT(system_error("arena { csv 'no.csv' }"),
               Catch::StartsWith("s.lua:1: csv: there is no file 'no.csv'; looked for "));
    CHECK_THAT(system_error("arena { floor { image = 'no.png', size = { 1, 1 } } }"),
               Catch::StartsWith("s.lua:1:17: floor: there is no file 'no.png'; looked for "));
    CHECK_THAT(system_error("arena { floor { size = { 1, 1 } } }"),
               Catch::StartsWith("s.lua:1: floor: field 'image' is missing: expected a text: a picture"));
}

TEST_CASE("names are free identifiers", "[lua][system_file]") {
    CHECK(system_error("robot 'm' { model = 'raspimouse' }\nbehavior 'm' { script = 'robot_controller' }") ==
          "s.lua:2: behavior 'm': the name is taken by the robot of behaviors/systems/s.lua:1");
    CHECK(system_error("robot 'my mouse' { model = 'raspimouse' }") ==
          "s.lua:1: robot 'my mouse': a name consists of letters, digits and _, and does not begin with a digit");
    CHECK_THAT(system_error("robot '1st' {}"), Catch::Contains("does not begin with a digit"));
    CHECK_THAT(system_error("robot '' {}"), Catch::Contains("a name consists of letters"));
    CHECK(system_error("behavior 'step' {}") ==
          "s.lua:1: behavior 'step': 'step' is a word of Lua or of the console: choose another name");
    CHECK_THAT(system_error("behavior 'end' {}"), Catch::Contains("is a word of Lua"));
    CHECK(system_error("robot { model = 'raspimouse' }") ==
          "s.lua:1: robot: expected a name, got table: write robot \"NAME\" { ... }");
    CHECK(system_error("-- a name alone\nrobot 'm'") ==
          "s.lua:2: robot 'm': expected a table after the name: robot \"m\" { ... }");
    CHECK(system_error("robot('m', {}, 3)") ==
          "s.lua:1: robot: expected at most 2 arguments, got 3: robot \"NAME\" { ... }");
}

TEST_CASE("a set is one of the sets", "[lua][system_file]") {
    CHECK(system_error("behavior 'c' { script = 'robot_controller', sets = { careful = {} }, set = 'carefull' }") ==
          "s.lua:1:70: behavior 'c': field 'set': there is no set 'carefull' in 'sets' (did you mean 'careful'?)");
    CHECK(system_error("behavior 'c' { script = 'robot_controller', sets = { default = {} } }") ==
          "s.lua:1:54: behavior 'c': field 'sets.default': to use \"default\" is to have no set in use: choose another "
          "name");
    CHECK_THAT(system_error("behavior 'c' { script = 'robot_controller', set = 'fast' }"),
               Catch::Contains("there is no set 'fast'"));
    CHECK(system_error("behavior 'c' { script = 'robot_controller', sets = { careful = 3 } }") ==
          "s.lua:1:54: behavior 'c': field 'sets.careful' expected a table, got number");
    CHECK(system_error("behavior 'c' { script = 'robot_controller', sets = { careful = { x = {{}} } } }") ==
          "s.lua:1:66: behavior 'c': field 'sets.careful.x' expected an array of numbers, of truth values or of texts");
}

TEST_CASE("a connection names two ports, once", "[lua][system_file]") {
    CHECK(system_error("connect('mouse', 'controller.in')") == "s.lua:1: connect: expected \"name.port\", got 'mouse'");
    CHECK(system_error("connect('mouse.a', 'controller.in.x')") ==
          "s.lua:1: connect: expected \"name.port\", got 'controller.in.x'");
    CHECK(system_error("connect('mouse.', 'controller.in')") ==
          "s.lua:1: connect: expected \"name.port\", got 'mouse.'");
    CHECK(system_error("connect('mouse.a')") == "s.lua:1: connect: expected \"name.port\", got nil");
    CHECK(system_error("connect(1, 2)") == "s.lua:1: connect: expected \"name.port\", got number");
    CHECK(system_error("connect()") == "s.lua:1: connect: expected \"name.port\", got nil");
    CHECK(system_error("connect('a.x', 'b.in')\nconnect('a.x', 'b.in')") ==
          "s.lua:2: connect: a.x is connected to b.in already, at behaviors/systems/s.lua:1");
    CHECK(system_of("connect('a.x', 'b.in') connect('a.x', 'c.in')").connections.size() == 2);
}

TEST_CASE("a component is carried by a robot that is there", "[lua][system_file]") {
    CHECK(system_error("robot 'mouse' { model = 'raspimouse' }\ncomponent 'eye' { type = 'Camera', on = 'mous' }") ==
          "s.lua:2: component 'eye': field 'on' names no robot: there is none 'mous' (did you mean 'mouse'?)");
}

TEST_CASE("globals that nobody knows are refused before anything runs", "[lua][system_file]") {
    CHECK_THAT(system_error("connect('a.x', 'b.y')\nif false then\n  robott 'm' {}\nend"),
               Catch::StartsWith("s.lua:3:3: "));
    CHECK_THAT(system_error("robott 'm' {}"), Catch::Contains("robot"));
    CHECK_THAT(system_error("count = 3"), Catch::StartsWith("s.lua:1:1: "));
    CHECK_THAT(system_error("io.open('x')"), Catch::Contains("'io'"));
    CHECK_THAT(system_error("os.exit(1)"), Catch::Contains("'os'"));
    CHECK_THAT(system_error("robot = nil"), Catch::StartsWith("s.lua:1:1: "));
}

TEST_CASE("what is no Lua, runs into an error or never ends is one message", "[lua][system_file][watchdog]") {
    CHECK_THAT(system_error("arena {\n  box {\n"), Catch::StartsWith("s.lua:"));
    CHECK_THAT(system_error("local a = nil\nlocal b = a.x"),
               Catch::StartsWith("s.lua:2: attempt to index a nil value"));
    CHECK(system_error("error('no arena today')") == "s.lua:1: no arena today");
    CHECK_THAT(system_error("\x1bLua"), Catch::Contains("bytecode"));
    CHECK(system_error("") == "s.lua: the file says nothing: expected robot, behavior, arena, connect ...");
    const auto endless = read("while true do end", {.seconds = 0.05});
    REQUIRE_FALSE(endless.has_value());
    CHECK(endless.error().kind == Error::Kind::out_of_time);
    CHECK(endless.error().place.line == 1);
    CHECK_THAT(system_error("local t = {} t.t = t robot('m', t)"),
               Catch::Contains("nested too deeply, or a table is within itself"));
    CHECK_THAT(system_error("local t = {} for i = 1, 1e9 do t[i] = ('x'):rep(1e5) .. i end"),
               Catch::Contains("memory"));
}

TEST_CASE("whatever a file says, a message is one short line", "[lua][system_file]") {
    CHECK(system_error("error('a\\nb\\27[2J\\0')") == "s.lua:1: a b?[2J?");
    CHECK_THAT(system_error("robot('a\\nb', {})"), Catch::StartsWith("s.lua:1: robot 'a b': a name consists"));
    CHECK(system_error("behavior('c', { script = ('x'):rep(100000) })").size() < 1100);
    CHECK(system_error("component('c', { type = 'Camera', on = 'a\\1' })") ==
          "s.lua:1: component 'c': field 'on' names no robot: there is none 'a?'");
    CHECK(system_error("local " + std::string(5000, 'x') + " = = 1").size() < 1100);
}

TEST_CASE("a zero byte ends no name in a system file", "[lua][system_file]") {
    const std::string mouse = "robot 'm' { model = 'raspimouse' } ";
    CHECK_THAT(system_error("robot('m\\0x', { model = 'raspimouse' })"), Catch::Contains("a name consists"));
    CHECK_THAT(system_error("robot('m', { model = 'raspimouse\\0x' })"),
               Catch::Contains("has a control character in it: '"));
    CHECK_THAT(system_error("behavior('c', { script = 'robot_controller\\0x' })"),
               Catch::Contains("has a control character in it: '"));
    CHECK_THAT(system_error(mouse + "connect('m\\0x.ir_sensor_out', 'm.target_velocity_in')"),
               Catch::Contains("'m?x.ir_sensor_out'"));
    CHECK_THAT(system_error("arena { csv 'map.csv\\0x' }"), Catch::Contains("has a control character in it: '"));
    CHECK_THAT(system_error(mouse + "error('a\\0b')"), Catch::Contains("a?b"));
}

TEST_CASE("a name never stands for a device", "[lua][system_file]") {
    CHECK_THAT(system_error("arena { csv '/dev/zero' }"),
               Catch::StartsWith("s.lua:1: csv: there is no file '/dev/zero'"));
}

TEST_CASE("an error that the file catches is an error all the same", "[lua][system_file]") {
    CHECK(system_error("pcall(rate, -1)\nrate(50)") ==
          "s.lua:1: rate: expected a positive number of ticks a second, got -1");
}

TEST_CASE("a missing system file is one plain message", "[lua][system_file]") {
    const Project project = Project::of("nothing.lua");
    CHECK(describe(read_system_file("nothing.lua", project).error()) == "nothing.lua: there is no such file");
    CHECK(describe(read_system_file("behaviors", project).error()) == "behaviors: is a folder, expected a file");
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

TEST_CASE("what RTCs see is said once, by names that there are", "[lua][system_file][rtm]") {
    const std::string c = "behavior 'c' { script = 'robot_controller' }\n";
    CHECK(system_error(c + "rtm { exports = 'c' }") ==
          "s.lua:2:7: rtm: unknown field 'exports' (did you mean 'export'?)");
    CHECK(system_error(c + "rtm { export = 5 }") ==
          "s.lua:2:7: rtm: field 'export' expected a name or a list of names, got number");
    CHECK(system_error(c + "rtm { export = { 'c', 'cc' } }") ==
          "s.lua:2: rtm: field 'export' names no component: there is none 'cc' (did you mean 'c'?)");
    CHECK(system_error(c + "rtm { export = { 'c', 'c' } }") == "s.lua:2:7: rtm: field 'export' has 'c' twice");
    CHECK(system_error(c + "rtm { export = 'c' }\nrtm {}") ==
          "s.lua:3: rtm: is set already, at behaviors/systems/s.lua:2");
    CHECK(system_error(c + "rtm { nameserver = 'localhost:0' }") ==
          "s.lua:2:7: rtm: field 'nameserver' expected \"HOST:PORT\", got 'localhost:0'");
    CHECK(system_error(c + "rtm { nameserver = 'corbaloc::localhost' }").find("expected \"HOST:PORT\"") !=
          std::string::npos);
    CHECK(system_error(c + "rtm { interface = 'eth0' }") ==
          "s.lua:2:7: rtm: field 'interface' expected an address as 192.168.1.10, got 'eth0'");
    CHECK(system_error(c + "rtm { interface = '1.2.3.256' }").find("got '1.2.3.256'") != std::string::npos);
    CHECK(system_error(c + "rtm { export = 'c', rename = { ['d.in'] = 'x' } }")
              .find("field 'rename' gives 'd.in' another name: expected \"name.port\" of a component that is "
                    "exported") != std::string::npos);
    CHECK(system_error(c + "rtm { export = 'c', rename = { ['c.in'] = 'a b' } }")
              .find("field 'rename' gives 'c.in' another name: 'a b' is no name of a port") != std::string::npos);
    CHECK(system_error(c + "rtm { export = 'c', rename = { ['c.in'] = 5 } }")
              .find("field 'rename' gives 'c.in' another name: expected a port's name there, got 5") !=
          std::string::npos);
}

TEST_CASE("one end of a connection may be another program's port, and the other is exported",
          "[lua][system_file][rtm]") {
    const std::string c = "behavior 'c' { script = 'robot_controller' }\n";
    const std::string exported = c + "rtm { export = 'c' }\n";
    CHECK(system_error(c + "connect('rtm:Out0.out', 'c.in')") ==
          "s.lua:2: connect: rtm:Out0.out is a port of another program, which sees only what is exported: write rtm { "
          "export = { \"c\" } }");
    CHECK(system_error(exported + "connect('rtm:Out0.out', 'cc.in')") ==
          "s.lua:3: connect: there is no component 'cc' (did you mean 'c'?)");
    CHECK(system_error(exported + "connect('rtm:Out0.out', 'rtm:In0.in')") ==
          "s.lua:3: connect: both ends are ports of other programs: one of them must be of this system");
    for (const std::string slip :
         {"rtm:", "rtm:out", "rtm:.out", "rtm:Out0.", "rtm:/Out0.out", "rtm:a//b.out", "rtm:a.b/c", "rtm:Out 0.out"}) {
        CHECK(system_error(exported + "connect('" + slip + "', 'c.in')") ==
              "s.lua:3: connect: expected \"rtm:NAME.port\" or \"rtm:HOST.host_cxt/NAME.port\", got '" + slip + "'");
    }
    CHECK(system_error(exported + "connect('rtm:Out0.out', 'c.in')\nconnect('rtm:Out0.out', 'c.in')") ==
          "s.lua:4: connect: rtm:Out0.out is connected to c.in already, at behaviors/systems/s.lua:3");
}
