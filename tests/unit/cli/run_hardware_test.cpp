// `--hw`: which robots are real, and what is refused before anything moves.
#include "bindings/cli/run/hardware.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::cli;

namespace {

SystemSpec two_mice() {
    SystemSpec spec;
    spec.file = "two.lua";
    spec.models["mouse"].hardware.driver = "raspimouse";
    spec.models["toy"];
    for (const char* name : {"first", "second"}) {
        RobotEntry robot;
        robot.name = name;
        robot.model = "mouse";
        robot.place = {"two.lua", 1};
        spec.entries.emplace_back(robot);
    }
    return spec;
}

RobotEntry& robot(SystemSpec& spec, std::size_t index) { return std::get<RobotEntry>(spec.entries[index]); }

decltype(Makers::components) devices() {
    return {{"Camera", {{"camera", nullptr}}}, {"Joystick", {{"gamepad", nullptr}}}};
}

ComponentEntry& add_component(SystemSpec& spec, const char* name, const char* type, const char* on = "") {
    ComponentEntry component;
    component.name = name;
    component.type = type;
    component.on = on;
    component.place = {"two.lua", 4};
    spec.entries.emplace_back(component);
    return std::get<ComponentEntry>(spec.entries.back());
}

std::string backend_of(const SystemSpec& spec, std::string_view name) {
    for (const Entry& entry : spec.entries) {
        const auto* component = std::get_if<ComponentEntry>(&entry);
        if (component != nullptr && component->name == name) return component->backend;
    }
    return "no such component";
}

std::string refused(SystemSpec spec, const std::vector<std::string>& robots = {}) {
    const auto chosen = choose_drivers(spec, robots, devices());
    return chosen ? "" : describe(chosen.error());
}

}  // namespace

TEST_CASE("each robot gets the driver of its model by --hw, and simulated ones are left alone", "[cli][hw]") {
    SystemSpec all = two_mice();
    REQUIRE(choose_drivers(all, {}, devices()));
    CHECK(robot(all, 0).backend == "raspimouse");
    CHECK(robot(all, 1).backend == "raspimouse");

    SystemSpec one = two_mice();
    REQUIRE(choose_drivers(one, {"second"}, devices()));
    CHECK(robot(one, 0).backend.empty());
    CHECK(robot(one, 1).backend == "raspimouse");

    SystemSpec named = two_mice();
    robot(named, 0).backend = robot(named, 1).backend = "raspimouse";
    REQUIRE(choose_drivers(named, {"second"}, devices()));
    CHECK(robot(named, 0).backend.empty());
    CHECK(robot(named, 1).backend == "raspimouse");

    SystemSpec kept = two_mice();
    robot(kept, 0).backend = "sim";
    robot(kept, 1).backend = "other";
    REQUIRE(choose_drivers(kept, {}, devices()));
    CHECK(robot(kept, 0).backend == "sim");
    CHECK(robot(kept, 1).backend == "other");
}

TEST_CASE("a robot that --hw can't make real is refused with its line", "[cli][hw]") {
    CHECK(refused(two_mice(), {"frist"}) ==
          "--hw: there is no robot or device 'frist' in two.lua (did you mean 'first'?)");
    SystemSpec toy = two_mice();
    robot(toy, 1).model = "toy";
    CHECK(
        refused(toy) ==
        "two.lua:1: robot 'second': its model 'toy' names no driver: add hardware = { driver = ... } to the model, or "
        "keep the robot simulated by backend = \"sim\"");
    CHECK(refused(toy, {"first"}).empty());
    SystemSpec kept = two_mice();
    robot(kept, 0).backend = "sim";
    CHECK(refused(kept, {"first"}) ==
          "two.lua:1: robot 'first': --hw=first selects the real one, but backend = \"sim\" keeps it simulated: remove "
          "one of the two");
    robot(kept, 1).backend = "sim";
    CHECK(refused(kept) == "--hw: two.lua has no robot or device that can be real");
    SystemSpec slow = two_mice();
    slow.rate = 9.9;
    slow.rate_place = {"two.lua", 3};
    CHECK(refused(slow) ==
          "two.lua:3: --hw: 9.9 ticks per second are too few to drive a real robot: expected 10 or more");
    slow.rate = 10;
    CHECK(refused(slow).empty());
}

TEST_CASE("the option --hw makes devices real too, and a device on a robot is real if the robot is", "[cli][hw]") {
    SystemSpec spec = two_mice();
    add_component(spec, "stick", "Joystick");
    add_component(spec, "eye", "Camera", "second");
    add_component(spec, "finder", "MarkerDetector");
    const auto chosen = [&](const std::vector<std::string>& names) {
        SystemSpec trial = spec;
        REQUIRE(choose_drivers(trial, names, devices()));
        CHECK(backend_of(trial, "finder").empty());
        return backend_of(trial, "stick") + "|" + backend_of(trial, "eye");
    };
    CHECK(chosen({}) == "gamepad|camera");
    CHECK(chosen({"first"}) == "|");
    CHECK(chosen({"second"}) == "|camera");
    CHECK(chosen({"stick"}) == "gamepad|");
    CHECK(chosen({"first", "stick"}) == "gamepad|");
    robot(spec, 1).backend = "sim";
    CHECK(chosen({}) == "gamepad|");
}

TEST_CASE("a device with backend = 'sim' stays simulated, and --hw for it is refused with its line", "[cli][hw]") {
    SystemSpec spec = two_mice();
    add_component(spec, "stick", "Joystick").backend = "sim";
    SystemSpec all = spec;
    REQUIRE(choose_drivers(all, {}, devices()));
    CHECK(backend_of(all, "stick") == "sim");
    CHECK(refused(spec, {"stick"}) ==
          "two.lua:4: component 'stick': --hw=stick selects the real one, but backend = \"sim\" keeps it simulated: "
          "remove one of the two");
    CHECK(refused(spec, {"stik"}) == "--hw: there is no robot or device 'stik' in two.lua (did you mean 'stick'?)");
    add_component(spec, "finder", "MarkerDetector");
    CHECK(refused(spec, {"finder"}).starts_with("--hw: there is no robot or device 'finder' in two.lua"));
}

TEST_CASE("an unknown backend of a device is refused with the nearest name", "[cli][hw]") {
    const Scratch scratch;
    scratch.write("system.lua",
                  "component 'stick' { type = 'Joystick', backend = 'gamepat' }\n"
                  "robot 'mouse' { model = 'raspimouse', backend = 'sim' }\n");
    const Outcome outcome = run_nezumi({"run", "system.lua", "--hw=stick", "--headless"}, scratch.path("").string());
    CHECK(outcome.status == 2);
    CHECK(outcome.error ==
          "system.lua:1: component 'stick': there is no backend 'gamepat' (did you mean 'gamepad'?)\n");
}

TEST_CASE("options that real robots don't know are refused", "[cli][hw]") {
    const auto said = [](std::vector<std::string> words) {
        words.insert(words.begin(), {"run", "behaviors/systems/stop_at_wall.lua"});
        const Outcome outcome = run_nezumi(std::move(words));
        CHECK(outcome.status == 2);
        return outcome.error;
    };
    CHECK(said({"--hw", "--speed", "2"}) == "nezumi: --hw: real robots run only in real time: leave out --speed\n");
    CHECK(said({"--hw", "--batch"}) == "nezumi: --hw: real robots run only in real time: leave out --batch\n");
    CHECK(said({"--hw", "--replay", "x"}) == "nezumi: --hw: real robots run only in real time: leave out --replay\n");
    CHECK(said({"--hw=mouse,,", "--headless"}) ==
          "nezumi: --hw: expected names of robots as in --hw=mouse, got 'mouse,,'\n");
    CHECK(said({"--dev-root", "x"}) == "nezumi: --dev-root is for real robots: give --hw as well\n");
    CHECK(said({"--sys-root", "x"}) == "nezumi: --sys-root is for real robots: give --hw as well\n");
    CHECK(said({"--device-log", "x"}) == "nezumi: --device-log is for real robots: give --hw as well\n");
    CHECK(said({"--device-log-play", "x"}) == "nezumi: --device-log-play is for real robots: give --hw as well\n");
    for (const char* option : {"--dev-root", "--sys-root", "--device-log"})
        CHECK(said({"--hw", "--device-log-play", "x", option, "y"}) ==
              std::string("nezumi: --device-log-play: no device is used: leave out ") + option + "\n");
    CHECK(said({"--hw", "--headless", "--device-log", "/no/such/folder/x.log"}) ==
          "/no/such/folder/x.log: can't be written: No such file or directory\n");
    CHECK(said({"--hw=moose", "--headless"}) ==
          "nezumi: --hw: there is no robot or device 'moose' in behaviors/systems/stop_at_wall.lua (did you mean "
          "'mouse'?)\n");
}

TEST_CASE("without its motors a real robot's run ends at once, and says what to do", "[cli][hw][safety]") {
    const Scratch scratch;
    const std::string folder = scratch.path("").string();
    const Outcome outcome =
        run_nezumi({"run", "behaviors/systems/stop_at_wall.lua", "--hw", "--headless", "--dev-root", folder});
    CHECK(outcome.status == 2);
    CHECK(outcome.error.find(
              "motors: " + folder +
              "/rtmotoren0: no such file or directory: is the driver loaded? Try: sudo modprobe rtmouse\n") !=
          std::string::npos);
}

TEST_CASE("a robot of a system may name its driver itself", "[cli][hw]") {
    SystemSpec spec = two_mice();
    robot(spec, 1).model = "toy";
    robot(spec, 1).description = "toy of its own";
    spec.models["toy of its own"].hardware.driver = "ev3";
    REQUIRE(choose_drivers(spec, {}, devices()));
    CHECK(robot(spec, 0).backend == "raspimouse");
    CHECK(robot(spec, 1).backend == "ev3");
}
