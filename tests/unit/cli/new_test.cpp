// What `nezumi new` writes, and what it refuses to.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/files/check_files.hpp"
#include "bindings/cli/new/arguments.hpp"
#include "bindings/cli/new/behavior.hpp"
#include "bindings/cli/new/files.hpp"
#include "bindings/cli/new/project.hpp"
#include "engine/components/component.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::cli;

namespace {

std::string refusal(const NewBehavior& wanted) {
    const auto texts = write_behavior(wanted);
    return texts ? "nothing" : texts.error().message;
}

}  // namespace

TEST_CASE("a new behaviour has the ports and parameters of the command line", "[cli][new]") {
    const auto texts = write_behavior({.name = "AvoidWall",
                                       .inputs = {"distance:TimedShortSeq"},
                                       .outputs = {"out:TimedVelocity2D"},
                                       .parameters = {"speed=0.1", "greeting=good day"}});
    REQUIRE(texts.has_value());
    CHECK(texts->name == "avoid_wall");
    CHECK(texts->behavior == R"(--- AvoidWall: say in a sentence what it does.

local distance = input("distance", "TimedShortSeq", "a sequence of 16-bit integers")
local out      = output("out", "TimedVelocity2D", "a velocity in the robot's own frame")

param("speed", 0.1, { doc = "read as config.speed" })
param("greeting", "good day", { doc = "read as config.greeting" })

function on_execute()
  local distance_now = distance:read()
  out:write { vx = 0, vy = 0, va = 0 }
end
)");
    CHECK(texts->scenario == R"(scenario("avoid_wall runs", { timeout = 10 }, function(s)
  s:behavior "avoid_wall" { script = "avoid_wall" }
  local avoid_wall = s.world.avoid_wall

  s:always("is well", function() return avoid_wall.status == "ACTIVE" end)
  s:inject("avoid_wall.distance", { 0, 0 })
  s:run(1)
  s:check(avoid_wall.out.tm > 0, "out was written")
end)
)");
}

TEST_CASE("a new behaviour and its scenario pass nezumi check whatever the types and names", "[cli][new]") {
    NewBehavior all{.name = "all_types", .inputs = {}, .outputs = {}, .parameters = {"in=1"}};
    all.parameters.clear();
    for (const std::string_view type : message_type_names) {
        all.inputs.push_back("in_" + std::to_string(all.inputs.size()) + ":" + std::string(type));
        all.outputs.push_back("out_" + std::to_string(all.outputs.size()) + ":" + std::string(type));
    }
    const std::vector<NewBehavior> some{
        all,
        {.name = "bare", .inputs = {}, .outputs = {}, .parameters = {}},
        {.name = "Keywords", .inputs = {"in:TimedShort", "end:TimedShort"}, .outputs = {"while:TimedShort"}},
        {.name = "table", .inputs = {"text:TimedString"}, .outputs = {"out:TimedString"}},
        {.name = "watch", .inputs = {}, .outputs = {"s:TimedString"}},
        {.name = "s", .inputs = {}, .outputs = {"x:TimedString"}},
    };
    for (const NewBehavior& wanted : some) {
        const auto texts = write_behavior(wanted);
        INFO((texts ? wanted.name : texts.error().message));
        REQUIRE(texts.has_value());
        const Scratch files;
        for (const auto& file : {files.write("behaviors/" + texts->name + ".lua", texts->behavior),
                                 files.write("tests/" + texts->name + "_test.lua", texts->scenario)}) {
            const auto errors = check_file(file, simulated_systems());
            INFO((errors.empty() ? "" : describe(errors.front())));
            CHECK(errors.empty());
        }
    }
}

TEST_CASE("names of behaviours are words, in either spelling", "[cli][new]") {
    CHECK(new_file_name("behaviour", "LineFollower") == "line_follower");
    CHECK(new_file_name("behaviour", "line_follower") == "line_follower");
    CHECK(new_file_name("behaviour", "EV3Follower") == "ev3_follower");
    CHECK(new_file_name("behaviour", "Follow2Lines") == "follow2_lines");
    const auto refused = [](const std::string& name) { return new_file_name("behaviour", name).error().message; };
    CHECK(refused("my-robot") ==
          "'my-robot' can't be a behaviour's name: letters, digits and _, not beginning with a digit (did you mean "
          "'my_robot'?)");
    CHECK(refused("behaviors/a.lua") ==
          "'behaviors/a.lua' can't be a behaviour's name: letters, digits and _, not beginning with a digit (did you "
          "mean 'a'?)");
    CHECK(refused("2fast") == "'2fast' can't be a behaviour's name: letters, digits and _, not beginning with a digit");
    CHECK(refused("end") == "'end' can't be a behaviour's name: it is a word of Lua");
    CHECK(refused("wall_test") == "'wall_test' can't be a behaviour's name: files called *_test.lua are scenarios");
    CHECK(refused("") == "a behaviour needs a name, for example line_follower");
}

TEST_CASE("a default's text says its type", "[cli][new]") {
    CHECK(default_text("30") == "30");
    CHECK(default_text("-0.5") == "-0.5");
    CHECK(default_text("+1e3") == "1e3");
    CHECK(default_text("true") == "true");
    CHECK(default_text("hello world") == "\"hello world\"");
    CHECK(default_text("\"30\"") == "\"30\"");
    CHECK(default_text("") == "\"\"");
    CHECK(default_text("say \"hi\"\n") == "\"say \\\"hi\\\"\\n\"");
    CHECK(default_text("{1.0,0.5}") == "{ 1.0, 0.5 }");
    CHECK(default_text("{ a, b }") == "{ \"a\", \"b\" }");
    const auto refused = [](const std::string& text) { return default_text(text).error().message; };
    CHECK(refused("0,5") == "'0,5' is no number: write 30, 0.5 or -1e-3, or a text in quotes");
    CHECK(refused("1.2.3") == "'1.2.3' is no number: write 30, 0.5 or -1e-3, or a text in quotes");
    CHECK(refused("1e999") == "'1e999' is no number: write 30, 0.5 or -1e-3, or a text in quotes");
    CHECK(refused("nan") == "'nan' is no number: write 30, 0.5 or -1e-3, or a text in quotes");
    CHECK(refused("ture") == "'ture' (did you mean 'true'?); a text like this needs quotes");
    CHECK(refused("{}") == "an empty array has no type: write at least one element");
    CHECK(refused("{1, 2") == "'{1, 2' has no } at its end");
    CHECK(refused("{{1}}") == "arrays of arrays are no parameters");
}

TEST_CASE("a wrong word on the command line is one plain line with the nearest name", "[cli][new]") {
    CHECK(refusal({.name = "a", .inputs = {"x:TimedShrt"}}) ==
          "--in 'x': unknown type 'TimedShrt' (did you mean 'TimedShort'?); `nezumi types` lists them all");
    CHECK(refusal({.name = "a", .outputs = {"x"}}) ==
          "--out 'x': expected name:Type, for example --out distance:TimedShortSeq");
    CHECK(refusal({.name = "a", .inputs = {"x-y:TimedShort"}}) ==
          "--in 'x-y': a name consists of letters, digits and _, and does not begin with a digit");
    CHECK(refusal({.name = "a", .inputs = {"x:TimedShort"}, .outputs = {"x:TimedShort"}}) ==
          "--out 'x': the name is given twice");
    CHECK(refusal({.name = "a", .inputs = {"config:TimedShort"}}) ==
          "input 'config': the name is one of a component's own words: choose another, as 'my_config'");
    CHECK(refusal({.name = "a", .parameters = {"speed"}}) ==
          "--param 'speed': expected name=default, for example --param speed=0.1");
    CHECK(refusal({.name = "a", .parameters = {"speed=0,1"}}) ==
          "--param 'speed': '0,1' is no number: write 30, 0.5 or -1e-3, or a text in quotes");
    CHECK(refusal({.name = "a", .parameters = {"x=1", "x=2"}}) == "--param 'x': the name is given twice");
}

TEST_CASE("a new behaviour has the documentation, units and bounds of the command line", "[cli][new]") {
    const auto texts = write_behavior(
        {.name = "hold_line",
         .inputs = {"offset:TimedDouble:from the line [m]; left is positive"},
         .outputs = {"out:TimedVelocity2D"},
         .parameters = {"gain=0.01,min=0,max=1,unit=1/s,doc=of the error, per second", "mode=slow,choices={slow,fast}"},
         .doc = "Keeps to a line."});
    REQUIRE(texts.has_value());
    CHECK_THAT(texts->behavior,
               Catch::StartsWith("--- Keeps to a line.\n\n"
                                 "local offset = input(\"offset\", \"TimedDouble\", \"from the line [m]; left is "
                                 "positive\")\n"));
    CHECK_THAT(texts->behavior,
               Catch::Contains("param(\"gain\", 0.01, { min = 0, max = 1, unit = \"1/s\", doc = \"of the error, per "
                               "second\" })\n"
                               "param(\"mode\", \"slow\", { choices = { \"slow\", \"fast\" }, doc = \"read as "
                               "config.mode\" })\n"));
}

TEST_CASE("a new behaviour has the callbacks of the command line, in the order in which they are called",
          "[cli][new]") {
    const auto texts = write_behavior({.name = "careful", .callbacks = {"on_reload", "on_execute", "on_activated"}});
    REQUIRE(texts.has_value());
    CHECK_THAT(texts->behavior, Catch::EndsWith(R"(function on_activated()
  -- Before its first execution.
end

function on_execute()
  -- What it does, 100 times a second.
end

function on_reload(old_version)
  -- When a new version of this file takes over from version old_version.
end
)"));
    const std::vector<std::string_view>& all = hook_names();
    const auto every = write_behavior({.name = "careful", .callbacks = {all.begin(), all.end()}});
    REQUIRE(every.has_value());
    for (const std::string_view callback : all) {
        CHECK_THAT(every->behavior, Catch::Contains("function " + std::string(callback) + "("));
    }
    CHECK(every->behavior.find("  -- \n") == std::string::npos);
    CHECK(refusal({.name = "a", .callbacks = {"on_activate"}}) ==
          "--callback 'on_activate': there is no such callback (did you mean 'on_activated'?); known are on_activated, "
          "on_execute, on_deactivated, on_aborting, on_error, on_reset, on_reload");
    CHECK(refusal({.name = "a", .callbacks = {"on_error", "on_error"}}) ==
          "--callback 'on_error': the name is given twice");
}

TEST_CASE("what is said of a parameter is read in any order, and a slip is told", "[cli][new]") {
    const auto read = [](const std::string& text) {
        const auto parameter = read_new_parameter(text);
        return parameter ? parameter->name + ": " + parameter->initial + " { " + parameter->options + " }"
                         : parameter.error().message;
    };
    CHECK(read("a=1") == "a: 1 { doc = \"read as config.a\" }");
    CHECK(read("a=1, doc=x,max=2") == "a: 1 { max = 2, doc = \"x\" }");
    CHECK(read("a={1.0,0.5},min=0") == "a: { 1.0, 0.5 } { min = 0, doc = \"read as config.a\" }");
    CHECK(read("a=well, well=known") == "a: \"well, well=known\" { doc = \"read as config.a\" }");
    CHECK(read("a=0.5,mni=0") == "--param 'a': there is no 'mni' (did you mean 'min'?)");
    CHECK(read("a=0.5,min=low") == "--param 'a': min: expected a number, got 'low'");
    CHECK(read("a=0.5,min=0,min=1") == "--param 'a': 'min' is given twice");
    CHECK(read("a=x,choices=x") == "--param 'a': choices: expected { a, b }, got 'x'");
    CHECK(refusal({.name = "b", .parameters = {"a=2.0,max=1"}}).find('a') != std::string::npos);
    CHECK(refusal({.name = "b", .parameters = {"a=2.0,max=1"}}) != "nothing");
    CHECK(refusal({.name = "b", .doc = "x\nos.exit()"}) == "--doc: expected one line");
}

TEST_CASE("a new system loads, and one that would not is not written", "[cli][new]") {
    const Scratch files;
    std::filesystem::create_directories(files.path("behaviors"));
    const std::string folder = files.path("").string();
    const Outcome wrote =
        run_nezumi({"new", "system", "Round", "--robot", "left=raspimouse", "--robot", "right=raspimouse", "--behavior",
                    "controller=robot_controller", "--connect", "controller.out=left.target_velocity_in"},
                   folder);
    CHECK(wrote.error.empty());
    CHECK(wrote.out == "wrote behaviors/systems/round.lua\nnow try: nezumi run round\n");
    CHECK_THAT(
        text_of_file(files.path("behaviors/systems/round.lua")),
        Catch::Contains("robot    \"left\"       { model = \"raspimouse\", pose = { x = 0, y = -0.2, heading = 0 } }\n"
                        "robot    \"right\"      { model = \"raspimouse\", pose = { x = 0, y = 0.2, heading = 0 } }\n"
                        "behavior \"controller\" { script = \"robot_controller\" }\n\n"
                        "connect(\"controller.out\", \"left.target_velocity_in\")\n"));
    CHECK(run_nezumi({"run", "round", "--headless", "--speed", "max", "--duration", "0.1"}, folder).status == 0);

    const auto refused = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"new", "system"});
        const Outcome outcome = run_nezumi(std::move(words), folder);
        CHECK(outcome.status == 2);
        return outcome.error;
    };
    CHECK(refused({"a", "--robot", "mouse"}) ==
          "nezumi: new system: --robot 'mouse': expected NAME=MODEL, for example --robot mouse=raspimouse\n");
    CHECK_THAT(refused({"a", "--robot", "mouse=raspimous"}), Catch::Contains("(did you mean 'raspimouse'?)"));
    CHECK_THAT(refused({"a", "--connect", "mouse.ir_sensor_ou=mouse.target_velocity_in"}),
               Catch::Contains("(did you mean 'ir_sensor_out'?)"));
    CHECK(refused({"a", "--robot", "m=raspimouse", "--behavior", "m=robot_controller"}) ==
          "nezumi: new system: --behavior 'm': the name is given twice\n");
    CHECK_FALSE(std::filesystem::exists(files.path("behaviors/systems/a.lua")));
}

TEST_CASE("a new robot stands in a new system, and a new scenario for it passes", "[cli][new]") {
    const Scratch files;
    std::filesystem::create_directories(files.path("behaviors"));
    const std::string folder = files.path("").string();
    CHECK(run_nezumi({"new", "robot", "Tank"}, folder).out ==
          "wrote behaviors/tank.lua\nnow try: nezumi new system try_tank --robot tank=tank\n");
    CHECK(run_nezumi({"new", "system", "try_tank", "--robot", "tank=tank"}, folder).error.empty());
    CHECK(run_nezumi({"check", "."}, folder).out == "2 files: nothing wrong\n");
    CHECK(run_nezumi({"new", "scenario", "try_tank"}, folder).out ==
          "wrote tests/try_tank_test.lua\nnow try: nezumi test try_tank\n");
    const Outcome tested = run_nezumi({"test", "try_tank"}, folder);
    INFO(tested.out << tested.error);
    CHECK(tested.status == 0);
    CHECK(run_nezumi({"new", "scenario", "other"}, folder).error ==
          "nezumi: new scenario: for which system? Give --system, for example --system other\n");
    CHECK_THAT(run_nezumi({"new", "scenario", "other", "--system", "try_tnk"}, folder).error,
               Catch::Contains("there is no system file 'try_tnk' (did you mean 'try_tank'?)"));
}

TEST_CASE("a new file that is found in place of a shipped one says so in a line", "[cli][new]") {
    const Scratch files;
    std::filesystem::create_directories(files.path("behaviors"));
    const auto said = [&](const std::string& kind, const std::string& name) {
        const Outcome outcome = run_nezumi({"new", kind, name}, files.path("").string());
        CHECK(outcome.status == 0);
        return outcome.error;
    };
    const auto instead = [](const std::string& name, const std::string& file, const std::string& shipped) {
        return "nezumi: in this project '" + name + "' now means " + file + ", no longer the shipped " + shipped +
               ": rename it if that is not meant\n";
    };
    CHECK(said("behavior", "WallFollower") ==
          instead("wall_follower", "behaviors/wall_follower.lua", "behaviour behaviors/wall_follower.lua"));
    CHECK(said("behavior", "two_mice") ==
          instead("two_mice", "behaviors/two_mice.lua", "system behaviors/systems/two_mice.lua"));
    CHECK(said("system", "ev3") == instead("ev3", "behaviors/systems/ev3.lua", "robot engine/robots/ev3.lua"));
    CHECK(said("robot", "raspimouse") ==
          instead("raspimouse", "behaviors/raspimouse.lua", "robot engine/robots/raspimouse.lua"));
    CHECK(said("behavior", "mine").empty());
}

TEST_CASE("new files are written all or none, and nothing is overwritten", "[cli][new]") {
    const Scratch files;
    files.write("b.lua", "mine");
    const auto refused = write_new_files({{files.path("new/a.lua"), "a"}, {files.path("b.lua"), "b"}});
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().place.file == files.path("b.lua"));
    CHECK(refused.error().message == "exists already, and nothing is overwritten: choose another name or move it away");
    CHECK(text_of_file(files.path("b.lua")) == "mine");
    CHECK_FALSE(std::filesystem::exists(files.path("new")));

    // A file where a folder is needed shows itself only when the first one is written already.
    const auto half = write_new_files({{files.path("new/a.lua"), "a"}, {files.path("b.lua/c.lua"), "c"}});
    CHECK_FALSE(half.has_value());
    CHECK_FALSE(std::filesystem::exists(files.path("new")));

    CHECK(write_new_files({{files.path("new/deep/a.lua"), "a"}}).has_value());
    CHECK(text_of_file(files.path("new/deep/a.lua")) == "a");
}

TEST_CASE("a new project passes nezumi check and its robot explores without touching anything", "[cli][new]") {
    const Scratch folder;
    for (const NewFile& file : project_files("mine")) folder.write(file.path.string(), file.text);
    const auto files = lua_files({folder.path("").string()});
    REQUIRE(files.errors.empty());
    CHECK(files.files.size() == 3);
    for (const auto& file : files.files) CHECK(check_file(file, simulated_systems()).empty());
    CHECK(text_of_file(folder.path("README.md")).find("# mine\n") == 0);

    auto live = RunningSystem::load(folder.path("behaviors/systems/room.lua"), simulated_systems());
    REQUIRE(live.has_value());
    (*live)->activate();
    const System& system = (*live)->system();
    double path = 0;
    for (int tick = 0; tick < 6000; ++tick) {
        (*live)->tick();
        path += std::abs(system.world()->truth(system.find_robot("mouse")->id()).velocity.vx) * 0.01;
        REQUIRE_FALSE(system.world()->collided(0));
    }
    CHECK(path > 3);
}
