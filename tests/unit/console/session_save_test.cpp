// What `save` writes, and where.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>

#include "bindings/lua/files/system_file.hpp"
#include "tests/unit/console/session_rig.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("a saved system contains components that were added", "[console][session]") {
    SessionRig it;
    RobotEntry robot = std::get<RobotEntry>(it.live->spec().entries[0]);
    robot.name = "second";
    robot.model = "raspimouse";
    robot.pose.position = {0, 0.5};
    const SystemSpec& spec = it.live->spec();
    REQUIRE(it.live->act(Add{robot}, {}));
    CHECK_FALSE(it.live->act(Add{robot}, {}));  // the name is taken: nothing is added
    BehaviorEntry behavior = std::get<BehaviorEntry>(spec.entries[1]);
    behavior.name = "other";
    behavior.rate = 50;
    REQUIRE(it.live->act(Add{behavior}, {}));
    it.type("connect(other.out, second.target_velocity_in)");
    const std::string file = it.folder.path("saved.lua").string();
    CHECK(it.type("save '" + file + "'") == "saved " + file + ": 4 components, 3 connections");
    const auto saved = read_system_file(file, Project::of(file, {source_root()}));
    REQUIRE(saved.has_value());
    REQUIRE(saved->entries.size() == 4);
    CHECK(std::get<RobotEntry>(saved->entries[2]).pose.position.y == 0.5);
    CHECK(std::get<BehaviorEntry>(saved->entries[3]).rate == 50);
}

TEST_CASE("a saved system contains which components are active", "[console][session]") {
    const std::string fails = "param('x', 1)\nfunction on_execute() error('broken') end\n";
    const std::string idles = "param('x', 1)\nfunction on_execute() end\n";
    SessionRig it(R"(
robot "mouse" { model = "raspimouse" }
behavior "begun" { script = "idles", active = false }
behavior "ended" { script = "idles" }
behavior "broken" { script = "fails" }
component "stick" { type = "Joystick" }
)",
                  {{"idles", idles}, {"fails", fails}});
    CHECK(it.type("begun:activate() ended:deactivate() stick:deactivate()").empty());
    it.turn(2);
    CHECK(it.type("return broken.status, begun.status, ended.status") == "\"ERROR\"\t\"ACTIVE\"\t\"INACTIVE\"");
    const std::string file = it.folder.path("saved.lua").string();
    CHECK_THAT(it.type("save '" + file + "'"), StartsWith("saved "));
    const auto spec = read_system_file(file, Project::of(file, {source_root()}));
    REQUIRE(spec.has_value());
    std::map<std::string, bool> active;
    for (const Entry& entry : spec->entries)
        active[name_of(entry)] = std::visit([](const auto& each) { return each.active; }, entry);
    CHECK(active == std::map<std::string, bool>{
                        {"mouse", true}, {"begun", true}, {"ended", false}, {"broken", true}, {"stick", false}});
}

TEST_CASE("a system is not saved over a script of its own", "[console][session]") {
    SessionRig it;
    const std::string script = it.folder.path("behaviors/counter.lua").string();
    CHECK(it.type("save '" + script + "'") ==
          "! save: '" + script + "' is the script of controller: give the system's file another name");
    CHECK(text_of_file(script) == counter_behavior);
    CHECK_FALSE(std::filesystem::exists(script + "~"));
}

TEST_CASE("save writes only regular files, never waits, and leaves no other file", "[console][session]") {
    SessionRig it;
    const std::string pipe = it.folder.path("pipe.lua").string();
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(it.type("save '" + pipe + "'") == "! save: '" + pipe + "' is a FIFO: give another name");
    const std::string folder = it.folder.path("folder.lua").string();
    std::filesystem::create_directory(folder);
    CHECK(it.type("save '" + folder + "'") == "! save: '" + folder + "' is a folder: give another name");
    CHECK_FALSE(std::filesystem::exists(pipe + "~.new"));
    CHECK(std::filesystem::is_fifo(pipe));
}

TEST_CASE("save writes the present connections and configuration as a system file", "[console][session]") {
    SessionRig it;
    const std::string file = it.folder.path("saved.lua").string();
    it.type("controller.config.stop_d = 99 disconnect(mouse.ir_sensor_out)");
    CHECK(it.type("save '" + file + "'") == "saved " + file + ": 2 components, 1 connection");
    const auto spec = read_system_file(file, Project::of(file, {source_root()}));
    REQUIRE(spec.has_value());
    CHECK(spec->connections.size() == 1);
    const auto& controller = std::get<BehaviorEntry>(spec->entries[1]);
    CHECK(controller.config == ParameterValues{{"stop_d", std::int64_t{99}}});
    it.type("restart() controller:use 'fast'");
    CHECK_THAT(it.type("save '" + file + "'"), Contains("the previous file is now " + file + "~"));
    CHECK_THAT(text_of_file(file), Contains("set = \"fast\""));
    CHECK_THAT(text_of_file(file + "~"), Contains("stop_d = 99"));
    CHECK(it.type("save(3)") == "! save: expected the name of a file, as in save \"system.lua\", got number");
}

TEST_CASE("a robot is saved with the value of its parameter", "[console][session]") {
    SessionRig it(
        "robot 'ev' { model = 'ev3', mass = 0.7, actuators = { medium_motor = { maximum = 1.5 } } }\n"
        "robot 'other' { model = 'ev3', pose = { y = 1 } }\n",
        {});
    const std::string file = it.folder.path("saved.lua").string();
    CHECK(it.type("ev.config.medium_motor_speed = 3").empty());
    it.turn();
    CHECK_THAT(it.type("save '" + file + "'"), StartsWith("saved "));
    const auto spec = read_system_file(file, Project::of(file, {source_root()}));
    REQUIRE(spec.has_value());
    CHECK(std::get<RobotEntry>(spec->entries[1]).changes.empty());
    const RobotSpec& ev = spec->models.at(std::get<RobotEntry>(spec->entries[0]).described_by());
    CHECK(ev.mass == 0.7);
    for (const ActuatorSpec& actuator : ev.actuators) {
        if (actuator.name != "medium_motor") continue;
        CHECK(actuator.speed == 3.0);
        CHECK(actuator.maximum == 1.5);
    }
}

TEST_CASE("a value set by hand is saved in the parameter set in use if the set has it, otherwise in config",
          "[console][session]") {
    SessionRig it(
        "behavior 'it' { script = 'idles', config = { p = 2, gone = 1 }, sets = { g = { p = 9 }, h = { r = 4 } } }",
        {{"idles", "param('p', 1) param('q', 1) param('r', 1) param('gone', 1)\nfunction on_execute() end\n"}});
    const std::string file = it.folder.path("saved.lua").string();
    const auto saved = [&] {
        CHECK_THAT(it.type("save '" + file + "'"), StartsWith("saved "));
        return std::get<BehaviorEntry>(
            read_system_file(file, Project::of(file, {source_root()})).value().entries.front());
    };
    const auto whole = [](std::int64_t number) { return Value{number}; };
    CHECK(it.type("it:use 'g' it.config.q = 5").empty());
    const BehaviorEntry other = saved();
    CHECK(other.set == "g");
    CHECK(other.sets.at("g") == ParameterValues{{"p", whole(9)}});
    CHECK(other.config == ParameterValues{{"gone", whole(1)}, {"p", whole(2)}, {"q", whole(5)}});
    CHECK(it.type("it.config.p = 7").empty());
    const BehaviorEntry named = saved();
    CHECK(named.set == "g");
    CHECK(named.sets.at("g") == ParameterValues{{"p", whole(7)}});
    CHECK(named.sets.at("h") == ParameterValues{{"r", whole(4)}});
    CHECK(named.config.at("p") == whole(2));
}

TEST_CASE("save reports a deleted working folder, and the session continues", "[console][session]") {
    SessionRig it;
    const Scratch scratch;
    const std::filesystem::path before = std::filesystem::current_path();
    const std::filesystem::path gone = scratch.path("gone");
    std::filesystem::create_directory(gone);
    std::filesystem::current_path(gone);
    std::filesystem::remove(gone);
    const std::string answer = it.type("save 'saved.lua'");
    std::filesystem::current_path(before);
    CHECK(answer == "! save: 'saved.lua': the working folder is not known: No such file or directory");
    CHECK(it.type("1 + 1") == "2");
}

TEST_CASE("save only writes Lua files within the project", "[console][session]") {
    SessionRig it;
    const Scratch outside;
    const std::string home = it.folder.path("").parent_path().string();
    for (const std::string& name :
         {outside.path("x.lua").string(), home + "/../x.lua", std::string("/nowhere/at/all.lua")}) {
        CAPTURE(name);
        CHECK(it.type("save '" + name + "'") ==
              "! save: '" + name + "' lies outside of the project: a system must be saved in " + home + " or below");
        CHECK_FALSE(std::filesystem::exists(name));
    }
    std::filesystem::create_directory_symlink(outside.path(""), it.folder.path("link"));
    CHECK_THAT(it.type("save '" + home + "/link/x.lua'"), Contains("lies outside of the project"));
    CHECK(it.type("save '" + home + "/notes.txt'") ==
          "! save: the name of a system file must end in .lua: write save \"" + home + "/notes.lua\"");
    CHECK_THAT(it.type("save '" + home + "/a\\0b.lua'"), Contains("it contains a control character"));
    CHECK_THAT(it.type("save '" + home + "/a\\nb.lua'"), Contains("it contains a control character"));
    CHECK(it.type("save '" + home + "/behaviors/deep'") ==
          "saved " + home + "/behaviors/deep.lua: 2 components, 2 connections");
}

TEST_CASE("a saved system has the short name of a floor's picture", "[console][session]") {
    // A picture of one white pixel.
    const std::string png(
        "\211PNG\015\012\032\012\000\000\000\015IHDR\000\000\000\001\000\000\000\001\010\000\000\000\000\072\176\233U"
        "\000\000\000\012IDATx\234c\370\017\000\001\001\001\000\261\070\366\024\000\000\000\000IEND\256B\140\202",
        67);
    SessionRig it;
    it.folder.write("behaviors/maps/room.png", png);
    it.folder.write("system.lua", counter_system + "arena { floor { image = 'maps/room.png', size = { 1, 1 } } }");
    REQUIRE(it.live->act(Restart{}, {}));
    const std::string saved = it.folder.path("deep/er/saved.lua").string();
    it.folder.write("deep/er/.keep", "");
    CHECK_THAT(it.type("save '" + saved + "'"), StartsWith("saved "));
    CHECK_THAT(text_of_file(saved), Contains("image = \"maps/room.png\""));
    CHECK(read_system_file(saved, Project::of(saved, {source_root()})).has_value());
}
