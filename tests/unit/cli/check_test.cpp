// What `nezumi check` finds in files, and which kind it takes a file for.
#include <catch2/catch.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/json_text.hpp"
#include "bindings/cli/files/check_files.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;
using namespace nezumi::cli;

namespace {

// A project with files, and what is wrong with one of them, with the paths as they are in the project.
struct Checked {
    explicit Checked(std::string_view name, std::string_view text) { files.write(name, text); }

    Checked& with(std::string_view name, std::string_view text) {
        files.write(name, text);
        return *this;
    }
    std::vector<std::string> check(std::string_view name) const {
        std::vector<std::string> lines;
        const std::string root = files.path("").string();
        for (const Error& error : check_file(files.path(name), simulated_systems())) {
            std::string line = describe(error);
            for (std::size_t at = 0; (at = line.find(root)) != std::string::npos;) line.erase(at, root.size());
            lines.push_back(std::move(line));
        }
        return lines;
    }

    Scratch files;
};

using Lines = std::vector<std::string>;

// What is wrong with one file of this name.
Lines wrong(std::string_view name, std::string_view text) { return Checked(name, text).check(name); }

}  // namespace

TEST_CASE("a file's kind is told by its words, then by its folder", "[cli][check]") {
    CHECK(kind_of_file("a.lua", "local p = input('in', 'TimedShort')") == LuaKind::behavior);
    CHECK(kind_of_file("a.lua", "function on_execute() end") == LuaKind::behavior);
    CHECK(kind_of_file("a.lua", "function on_exectue() end") == LuaKind::behavior);
    CHECK(kind_of_file("systems/a.lua", "local p = input('in', 'TimedShort')") == LuaKind::behavior);
    CHECK(kind_of_file("a.lua", "robot 'mouse' { model = 'raspimouse' }") == LuaKind::system);
    CHECK(kind_of_file("a.lua", "require 'lib.arena' {}") == LuaKind::behavior);
    CHECK(kind_of_file("systems/a.lua", "require 'lib.arena' {}") == LuaKind::system);
    CHECK(kind_of_file("a.lua", "return { twice = function(x) return 2 * x end }") == LuaKind::module);
    CHECK(kind_of_file("a.lua", "return function() robot('m', {}) end") == LuaKind::system_module);
    CHECK(kind_of_file("a.lua", "function on_execute() if true then return end end") == LuaKind::behavior);
    CHECK(kind_of_file("a.lua", "return robot_model {}") == LuaKind::robot);
    CHECK(kind_of_file("robots/a.lua", "return robot_modle {}") == LuaKind::robot);
    CHECK(kind_of_file("a_test.lua", "") == LuaKind::scenario);
    CHECK(kind_of_file("a.lua", "calibration { robot = 'm' }") == LuaKind::calibration);
    CHECK(kind_of_file("m.calibration.lua", "calibraton {}") == LuaKind::calibration);
    CHECK(kind_of_file("a.lua", "scenario('x', function() end)") == LuaKind::scenario);
    CHECK(kind_of_file("nezumi.lua", "---@meta\nfunction input() end") == LuaKind::definitions);
}

TEST_CASE("a calibration is checked as it is read", "[cli][check]") {
    const std::string file = "behaviors/systems/mouse.calibration.lua";
    CHECK(wrong(file, "calibration { robot = 'mouse', model = 'raspimouse' }") == Lines{});
    CHECK(wrong(file, "calibration { robot = 'mouse', modle = 'raspimouse' }").front().starts_with(file + ":1"));
    CHECK(wrong(file, "calibration { robot = 'a', model = 'b' }\ncalibration { robot = 'a', model = 'b' }") ==
          Lines{file + ":2: calibration: is said twice: a file has one"});
}

TEST_CASE("a robot file that names no driver is told so, where a system with that robot would be", "[cli][check]") {
    const auto with = [](const std::string& driver) {
        return "return robot_model {\n  base = 'raspimouse',\n  hardware = {\n    driver = '" + driver + "' },\n}\n";
    };
    CHECK(wrong("behaviors/r.lua", with("raspimouse")) == Lines{});
    CHECK(
        wrong("behaviors/r.lua", with("raspimous")) ==
        Lines{"behaviors/r.lua:4:5: robot_model: field 'hardware.driver' expected a driver, there is none 'raspimous' "
              "(did you mean 'raspimouse'?)"});
    CHECK(
        wrong("behaviors/r.lua", with("hover")).front().ends_with("there is none 'hover'; there are ev3, raspimouse"));
}

TEST_CASE("a camera that could take no picture is refused before it runs", "[cli][check]") {
    const auto with = [](const std::string& fields) {
        return wrong("behaviors/systems/s.lua", "\ncomponent 'eye' { type = 'Camera', " + fields + " }\n");
    };
    const std::string at = "behaviors/systems/s.lua:2: component 'eye': ";
    CHECK(with("config = { frame_rate = 100, k1 = -0.1 }") == Lines{});
    CHECK(with("config = { frame_rate = 1000 }") == Lines{at + "frame_rate 1000 Hz is above the tick's 100 Hz"});
    CHECK(with("config = { k1 = -5 }") ==
          Lines{at + "a distortion of k1 = -5, k2 = 0, p1 = 0, p2 = 0, k3 = 0 folds the picture over: take smaller "
                     "ones, or a smaller field of view"});
}

TEST_CASE("every slip of a behaviour is found, and nothing of it is run", "[cli][check]") {
    CHECK(wrong("behaviors/a.lua",
                "local target = output('out', 'TimedVelocity2D')\n"
                "function on_execute()\n"
                "  if config.x then taget:write {} end\n"
                "  count = 1\n"
                "end\n"
                "function on_activate() end\n") ==
          Lines{"behaviors/a.lua:3:20: unknown global 'taget' (did you mean 'target'?)",
                "behaviors/a.lua:4:3: unknown global 'count' (declare it first: local count)",
                "behaviors/a.lua:6:10: unknown callback 'on_activate' (did you mean 'on_activated'?)"});
    CHECK(wrong("behaviors/a.lua", "local p = input('in', 'TimedShrot')\n") ==
          Lines{"behaviors/a.lua:1: input 'in': unknown type 'TimedShrot' (did you mean 'TimedShort'?); `nezumi types` "
                "lists them all"});
    CHECK(wrong("behaviors/a.lua",
                "local p = input('in', 'TimedShrot')\n"
                "local q = output('in', 'TimedShort', { saef = 1 })\n"
                "param('x', 3, { min = 4 })\n"
                "param('x', 1 / 0)\n"
                "command('go', 1)\n"
                "log.info(config.x)\n") ==
          Lines{"behaviors/a.lua:1: input 'in': unknown type 'TimedShrot' (did you mean 'TimedShort'?); `nezumi types` "
                "lists them all",
                "behaviors/a.lua:2: output 'in': unknown option 'saef' (did you mean 'safe'?)",
                "behaviors/a.lua:3: parameter 'x' (integer): 3 is below its minimum 4, in its default",
                "behaviors/a.lua:4: parameter 'x' (number): inf is not a finite number, in its default",
                "behaviors/a.lua:5: command 'go': expected a function, got number"});
    CHECK(wrong("behaviors/a.lua", "") ==
          Lines{"behaviors/a.lua: the file declares nothing: no port, parameter, command, task or callback"});
    CHECK(wrong("behaviors/a.lua", "function on_execute() error('never called') end") == Lines{});
}

TEST_CASE("a module's slip is found in the module and through the behaviour that requires it", "[cli][check]") {
    Checked project("behaviors/a.lua", "local steering = require 'lib.steering'\nfunction on_execute() end\n");
    project.with("behaviors/lib/steering.lua", "local M = {}\nfunction M.turn() return mth.pi end\nreturn M\n");
    const Lines found{"behaviors/lib/steering.lua:2:26: unknown global 'mth' (did you mean 'math'?)"};
    CHECK(project.check("behaviors/lib/steering.lua") == found);
    CHECK(project.check("behaviors/a.lua") == found);
}

TEST_CASE("a system is checked with its ports, types, parameters and scripts", "[cli][check]") {
    Checked project("behaviors/systems/a.lua", R"(robot "mouse" { model = "raspimouse" }
behavior "c" { script = "robot_controller", config = { speed_y = 1 } }
behavior "d" { script = "broken" }
behavior "e" { script = "robot_controller" }
connect("mouse.ir_sensor_outt", "e.in")
connect("mouse.ir_sensor_out", "e.out")
connect("e.out", "mouse.target_velocity_in")
connect("e.out", "d.in")
connect("mouse.ir_sensor_out", "mouse.target_velocity_in")
)");
    project.with("behaviors/broken.lua", "function on_execute() oops() end");
    CHECK(project.check("behaviors/systems/a.lua") ==
          Lines{"behaviors/systems/a.lua:2:56: c: config: unknown parameter 'speed_y' (did you mean 'speed_x'?)",
                "behaviors/broken.lua:1:23: unknown global 'oops'",
                "behaviors/systems/a.lua:5: mouse has no out-port 'ir_sensor_outt' (did you mean 'ir_sensor_out'?)",
                "behaviors/systems/a.lua:6: connect goes from an out-port to an in-port: mouse.ir_sensor_out "
                "(TimedShortSeq) "
                "is an out-port, e.out (TimedVelocity2D) is an out-port (did you mean 'e.in'?)",
                "behaviors/systems/a.lua:9: types differ: mouse.ir_sensor_out is TimedShortSeq, "
                "mouse.target_velocity_in is TimedVelocity2D (did you mean 'mouse.current_velocity_out'?)"});
}

TEST_CASE("a system is told what is wrong with the scripts that it names, each once", "[cli][check]") {
    Checked project("behaviors/systems/s.lua",
                    "behavior 'a' { script = 'slip' }\nbehavior 'b' { script = 'slip' }\n"
                    "behavior 'c' { script = 'wrong' }\nbehavior 'd' { script = 'good' }\nconnect('d.ou', 'd.in')");
    project.with("behaviors/good.lua", "output('out', 'TimedLong')");
    project.with("behaviors/slip.lua",
                 "local out = output('out', 'TimedLong')\nlocal function never() return config.q end\n"
                 "function on_execute() out:write(1) end");
    project.with("behaviors/wrong.lua", "local p = output('p', 'TimedLnog')\nparam('x', 1, { mim = 0 })");
    const Lines of_slip = project.check("behaviors/slip.lua");
    const Lines of_wrong = project.check("behaviors/wrong.lua");
    REQUIRE(of_slip.size() == 1);
    REQUIRE(of_wrong.size() == 2);
    CHECK(project.check("behaviors/systems/s.lua") ==
          Lines{of_slip[0], of_wrong[0], of_wrong[1],
                "behaviors/systems/s.lua:5: d has no out-port 'ou' (did you mean 'out'?)"});
}

TEST_CASE("the scripts of a system are checked with the values that it gives them", "[cli][check]") {
    Checked project("s.lua",
                    "behavior 'b' { script = 'picky', config = { side = 'left' } }\n"
                    "behavior 'c' { script = 'picky', sets = { near = { side = 'left' } }, set = 'near' }");
    project.with("behaviors/picky.lua",
                 "param('side', '')\nif config.side ~= 'left' then error('say side') end\nfunction on_execute() end");
    CHECK(project.check("s.lua").empty());
    project.with("s.lua", "behavior 'b' { script = 'picky', config = { side = 'right' } }");
    CHECK(project.check("s.lua") == Lines{"behaviors/picky.lua:2: say side"});
}

TEST_CASE("a global of another kind of file is told in a system as a run tells it", "[cli][check]") {
    const std::string of_behavior = "': it is a behaviour's; a system file says `behavior NAME { script = ... }`";
    Checked project("behaviors/systems/s.lua", "log.info('x')\nrate(50)\nseed(1)");
    CHECK(project.check("behaviors/systems/s.lua") ==
          Lines{"behaviors/systems/s.lua:1:1: unknown global 'log" + of_behavior});
    project.with("behaviors/b.lua", "local out = output('out', 'TimedLong')");
    project.with("behaviors/systems/s.lua", "rate(50) require 'b'");
    CHECK(project.check("behaviors/systems/s.lua") ==
          Lines{"behaviors/b.lua:1:13: unknown global 'output" + of_behavior});
}

TEST_CASE("the secret of a network is checked as a run would read it", "[cli][check][network]") {
    Checked checked("systems/s.lua", "rate(100)\nnetwork { name = 'pi', secret = 'nofile' }\nconnect('a.b', 'c.d')");
    const std::string none = "systems/s.lua:3: 'a.b': there is no component 'a'";
    CHECK(
        checked.check("systems/s.lua") ==
        Lines{
            "systems/s.lua:2: network: the secret 'nofile' is not there: `nezumi network secret FILE` makes one, to be "
            "copied to each host",
            none});
    checked.with("systems/nofile", "abc");
    std::filesystem::permissions(checked.files.path("systems/nofile"), std::filesystem::perms::owner_read);
    CHECK(checked.check("systems/s.lua") == Lines{"systems/s.lua:2: network: the secret 'nofile' is not a secret: "
                                                  "`nezumi network secret FILE` makes one, to be "
                                                  "copied to each host",
                                                  none});
}

TEST_CASE("robots that overlap, unknown models and fields are found in a system", "[cli][check]") {
    const Lines overlap =
        wrong("behaviors/systems/a.lua", "robot 'a' { model = 'raspimouse' }\nrobot 'b' { model = 'raspimouse' }\n");
    REQUIRE(overlap.size() == 1);
    CHECK(overlap[0].find("behaviors/systems/a.lua:2: ") == 0);
    const Lines model = wrong("behaviors/systems/a.lua", "robot 'a' { model = 'raspimose' }");
    REQUIRE(model.size() == 1);
    CHECK(model[0].find("(did you mean 'raspimouse'?)") != std::string::npos);
}

TEST_CASE("robot files, modules of systems and scenarios are checked", "[cli][check]") {
    CHECK(wrong("behaviors/r.lua", "return robot_model { mass = 1, drive = { radius = 0.02 } }").size() == 1);
    CHECK(wrong("behaviors/lib/m.lua", "return function() robot('m', {}); conect('a.b', 'c.d') end") ==
          Lines{"behaviors/lib/m.lua:1:35: unknown global 'conect' (did you mean 'connect'?)"});
    CHECK(wrong("tests/a_test.lua", "scenaro('x', function(s) end)") ==
          Lines{"tests/a_test.lua:1:1: unknown global 'scenaro' (did you mean 'scenario'?)"});
    CHECK(wrong("tests/a_test.lua", "scenario('x', function(s) error('never run') end)") == Lines{});
    const std::string flor = ": unknown field 'math.flor' (did you mean 'math.floor'?)";
    CHECK(wrong("tests/a_test.lua", "scenario('x', function(s) s:run(math.flor(1.5)) end)") ==
          Lines{"tests/a_test.lua:1:38" + flor});
    CHECK(wrong("behaviors/lib/m.lua", "return { f = function(x) return math.flor(x) end }") ==
          Lines{"behaviors/lib/m.lua:1:38" + flor});
    CHECK(wrong("behaviors/systems/s.lua", "rate(math.flor(50.5))") == Lines{"behaviors/systems/s.lua:1:11" + flor});
    CHECK(wrong("behaviors/r.lua", "return robot_model { mass = math.flor(1) }") ==
          Lines{"behaviors/r.lua:1:34" + flor});
    CHECK(wrong("tests/a_test.lua", "scenario('x', { timout = 3 }, function(s) end)").size() == 1);
}

TEST_CASE("what is shipped has nothing wrong with it", "[cli][check]") {
    const std::string root = source_root();
    const auto files = lua_files({root + "/behaviors", root + "/engine/robots"});
    REQUIRE(files.errors.empty());
    CHECK(files.files.size() >= 8);
    for (const auto& file : files.files) {
        const auto errors = check_file(file, simulated_systems());
        INFO((errors.empty() ? file.string() : describe(errors.front())));
        CHECK(errors.empty());
    }
}

TEST_CASE("systems are checked also where nothing can be simulated", "[cli][check]") {
    LiveOptions systems = simulated_systems();
    systems.world = nullptr;
    const std::string folder = source_root() + "/behaviors/systems/";
    for (const char* name : {"line_follower.lua", "leader_follower.lua"})
        CHECK(check_file(folder + name, systems).empty());
    const Scratch files;
    files.write("behaviors/systems/x.lua",
                "robot 'ev3' { model = 'ev3' }\nbehavior 'b' { script = 'errand' }\nconnect('ev3.touch', 'b.tuch')\n");
    const auto errors = check_file(files.path("behaviors/systems/x.lua"), systems);
    REQUIRE(errors.size() == 1);
    CHECK(errors.front().place.line == 3);
}

TEST_CASE("folders give their Lua files, sorted, once and without hidden ones", "[cli][check]") {
    const Scratch files;
    files.write("b.lua", "");
    files.write("a/c.lua", "");
    files.write("a/note.txt", "");
    files.write(".git/x.lua", "");
    const std::string root = files.path("").string();
    const auto found = lua_files({root, root + "b.lua"});
    REQUIRE(found.errors.empty());
    CHECK(found.files == std::vector<std::filesystem::path>{root + "a/c.lua", root + "b.lua"});

    const auto refused = [&](const std::string& path) {
        const auto result = lua_files({root + path});
        return result.errors.empty() ? std::string() : result.errors.front().message;
    };
    CHECK(refused("d.lua") == "there is no such file (did you mean '" + root + "b.lua'?)");
    CHECK(refused("a/note.txt") == "is no Lua file: `nezumi check` reads files that end in .lua, and folders");
    files.write("none/x.txt", "");
    CHECK(refused("none") == "has no Lua files");
}

TEST_CASE("texts become JSON whatever bytes they have", "[cli][check]") {
    CHECK(json_text("a \"b\" \\ \n\t\x01") == R"("a \"b\" \\ \n\t\u0001")");
    CHECK(json_text("gr\xc3\xb6\xc3\x9f"
                    "e \xf0\x9f\x90\xad") ==
          "\"gr\xc3\xb6\xc3\x9f"
          "e \xf0\x9f\x90\xad\"");
    CHECK(json_text("\xff \xc3 \xed\xa0\x80") == R"("\ufffd \ufffd \ufffd\ufffd\ufffd")");
}

TEST_CASE("ports of ours that lead to RTCs are checked without any", "[cli][check][rtm]") {
    const std::string system =
        "robot 'mouse' { model = 'raspimouse' }\n"
        "rtm { export = 'mouse', rename = { ['mouse.pose_updat'] = 'pose_update_in' } }\n"
        "connect('rtm:Out0.out', 'mouse.current_pose_out')\n"
        "connect('rtm:Out0.out', 'mouse.target_velocity_inn')\n"
        "connect('rtm:Out0.out', 'mouse.target_velocity_in')\n";
    CHECK(
        wrong("systems/s.lua", system) ==
        Lines{
            "systems/s.lua:2: rtm: field 'rename' names no port that is exported: there is none 'mouse.pose_updat' "
            "(did you mean 'mouse.pose_update'?)",
            "systems/s.lua:3: connect: mouse.current_pose_out is an out-port",
            "systems/s.lua:4: connect: mouse has no port 'target_velocity_inn' (did you mean 'target_velocity_in'?)"});
}
