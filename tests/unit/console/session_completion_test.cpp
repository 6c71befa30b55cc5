// What Tab offers: names, ports, fields, parameters and commands of the system that runs.
#include <catch2/catch.hpp>

#include "bindings/console/command_offers.hpp"
#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;

namespace {

// The candidates joined by blanks, and where they begin.
std::string offer(SessionRig& it, const std::string& text, std::size_t from) {
    const Completion completion = it.complete(text);
    CHECK(completion.from == from);
    std::string joined;
    for (const std::string& each : completion.candidates) joined += (joined.empty() ? "" : " ") + each;
    return joined;
}

}  // namespace

TEST_CASE("names are completed from the words, the library and the system", "[console][completion]") {
    SessionRig it;
    CHECK(offer(it, "cont", 0) == "controller");
    CHECK(offer(it, "print(mou", 6) == "mouse");
    CHECK(offer(it, "re", 0) == "rearm release reload remove repeat restart return");
    CHECK(offer(it, "xyz", 0).empty());
    it.type("my_table = { alpha = 1, beta = { gamma = 2 } }");
    CHECK(offer(it, "my_", 0) == "my_table");
    CHECK(offer(it, "my_table.", 9) == "alpha beta");
    CHECK(offer(it, "my_table.beta.g", 14) == "gamma");
    CHECK(offer(it, "math.fl", 5) == "floor");
    CHECK(offer(it, "1 + world.", 10) == "controller mouse");
}

TEST_CASE("members are completed from the live system", "[console][completion]") {
    SessionRig it;
    CHECK(offer(it, "controller.sta", 11) == "state status");
    CHECK(offer(it, "controller.i", 11) == "in");
    CHECK(offer(it, "controller.config.", 18) == "gains speed_x stop_d");
    CHECK(offer(it, "x = controller.config.sp", 22) == "speed_x");
    CHECK(offer(it, "controller.ports.", 17) == "in out");
    CHECK(offer(it, "controller:", 11) == "activate add both deactivate fail reset use");
    CHECK(offer(it, "mouse:t", 6) == "teleport");
    CHECK(offer(it, "controller.out.va", 15) == "value");
    CHECK(offer(it, "controller.out.value.", 21) == "va vx vy");
    CHECK(offer(it, "controller.in.va", 14) == "value");
    CHECK(offer(it, "controller['in'].pe", 17) == "peers");
    CHECK(offer(it, "controller.out:", 15) == "drop freeze hold inject release write");
    CHECK(offer(it, "mouse.truth.", 12) == "height pose tilt velocity");
    it.type("c = controller");
    CHECK(offer(it, "c.config.st", 9) == "stop_d");
    CHECK(offer(it, "f().co", 4).empty());
    CHECK(offer(it, "3.", 2).empty());
    CHECK(offer(it, "-- controller.", 14).empty());
    REQUIRE(it.live->act(Remove{"controller"}, {}).has_value());
    CHECK(offer(it, "c.config.", 9).empty());
}

TEST_CASE("fields are completed within values", "[console][completion]") {
    SessionRig it;
    CHECK(offer(it, "mouse.truth.pose.", 17) == "heading position");
    CHECK(offer(it, "mouse.truth.pose.position.", 26) == "x y");
    CHECK(offer(it, "mouse.truth.velocity.v", 21) == "va vx vy");
    CHECK(offer(it, "mouse.truth.tilt.", 17).empty());
    CHECK(offer(it, "mouse.truth.pose.heading.", 25).empty());
    CHECK(offer(it, "mouse.current_pose_out.value.position.", 38) == "x y");
    CHECK(offer(it, "mouse.ir_sensor_out.value.", 26).empty());
    CHECK(offer(it, "controller.state.", 17) == "count list");
    CHECK(offer(it, "controller.state.count.", 23).empty());
    CHECK(offer(it, "controller.probes.", 18).empty());
    CHECK(offer(it, "mouse.limits.", 13) == "acceleration speed yaw_acceleration yaw_rate");
    it.type("t = mouse.truth p = controller.out");
    CHECK(offer(it, "t.pose.p", 7) == "position");
    CHECK(offer(it, "p.value.", 8) == "va vx vy");
}

TEST_CASE("probes and tasks are completed by their names", "[console][completion]") {
    SessionRig it("behavior 'it' { script = 'it' }",
                  {{"it",
                    "task('go', function() wait(9) end) function on_execute() probe('error', 1) probe('gains', { 1, "
                    "d = 2 }) end"}});
    it.type("step(2)");
    CHECK(offer(it, "it.probes.", 10) == "error gains");
    CHECK(offer(it, "it.probes.gains.", 16) == "age tm value");
    CHECK(offer(it, "it.tasks.", 9) == "go");
    CHECK(offer(it, "it.tasks.go.", 12) == "line since status waiting");
}

TEST_CASE("fields are completed in the table that a port is given", "[console][completion]") {
    SessionRig it;
    CHECK(offer(it, "controller.out:write { v", 23) == "va vx vy");
    CHECK(offer(it, "controller.out:write({ vx = 1, v", 31) == "va vx vy");
    CHECK(offer(it, "controller.out:hold { vx = math.max(1, 2), v", 43) == "va vx vy");
    CHECK(offer(it, "inject(controller.out, { v", 25) == "va vx vy");
    CHECK(offer(it, "inject(mouse.ports[\"target_velocity_in\"], { v", 44) == "va vx vy");
    CHECK(offer(it, "hold('mouse.target_velocity_in', { v", 35) == "va vx vy");
    CHECK(offer(it, "mouse.pose_update:write { p", 26) == "position");
    CHECK(offer(it, "mouse.pose_update:write { position = { ", 39) == "x y");
    CHECK(offer(it, "mouse.pose_update:write { position = { x = 1 }, h", 48) == "heading");
    // What is no value of a port is as everywhere.
    CHECK(offer(it, "x = { contr", 6) == "controller");
    CHECK(offer(it, "print { contr", 8) == "controller");
    CHECK(offer(it, "controller.out:write { vx = contr", 28) == "controller");
    CHECK(offer(it, "inject({ contr", 9) == "controller");
    CHECK(offer(it, "controller.in:write { contr", 22) == "controller");
}

TEST_CASE("fields are completed in the table of what is added to the system", "[console][completion]") {
    SessionRig it;
    CHECK(offer(it, "behavior 'x' { s", 15) == "script set sets");
    CHECK(offer(it, "behavior('x', { s", 16) == "script set sets");
    CHECK(offer(it, "behavior 'x' { script = 'counter', a", 35) == "active");
    CHECK(offer(it, "component \"x\" { o", 16) == "on");
    CHECK(offer(it, "robot 'x' { mo", 12) == "model");
    CHECK(offer(it, "marker { fa", 9) == "facing");
    CHECK(offer(it, "behavior 'x' { script = mou", 24) == "mouse");
    CHECK(offer(it, "x = { fa", 6) == "false");
}

TEST_CASE("fields are completed in the options of a word", "[console][completion]") {
    SessionRig it;
    CHECK(offer(it, "plot(controller.out.vx, { e", 26) == "every");
    CHECK(offer(it, "plot('controller.out', 5, { e", 28) == "every");
    CHECK(offer(it, "hold(controller.out, { vx = 1 }, { t", 35) == "take");
    CHECK(offer(it, "hold(controller.out, { v", 23) == "va vx vy");
    CHECK(offer(it, "watch(controller.out, { contr", 24) == "controller");
}

TEST_CASE("every port that is plotted is completed within quotes", "[console][completion]") {
    SessionRig it;
    CHECK(offer(it, "plot('controller.o", 6) == "controller.out");
    CHECK(offer(it, "plot('controller.out', 'mouse.ta", 24) == "mouse.target_velocity_in");
    CHECK(offer(it, "inject('controller.in', 'mouse.ta", 25).empty());
}

TEST_CASE("every record whose fields a word's table has is described", "[console][completion]") {
    for (const ConsoleCommand& command : console_commands()) {
        if (command.table.record.empty()) continue;
        TextAtCursor call;
        call.word = command.name;
        call.argument = command.table.from;
        INFO(command.name);
        CHECK_FALSE(fields_of_table(call).empty());
    }
}

TEST_CASE("fields are completed in what is plotted", "[console][completion]") {
    SessionRig it;
    CHECK(offer(it, "plot(controller.out.", 20) == "va vx vy");
    CHECK(offer(it, "plot(mouse.truth, controller.out.v", 33) == "va vx vy");
    CHECK(offer(it, "plot(mouse.current_pose_out.position.", 37) == "x y");
    CHECK(offer(it, "plot(controller.out.value.v", 26) == "va vx vy");
    CHECK(offer(it, "plot(controller.o", 16) == "out");
    CHECK(offer(it, "watch(controller.out.va", 21) == "value");
}

TEST_CASE("names of things are completed within the quotes of a word", "[console][completion]") {
    SessionRig it;
    it.type("marker { name = 'target', id = 7, at = { 1, 0, 0.1 } }");
    CHECK(offer(it, "remove \"", 8) == "controller mouse target");
    CHECK(offer(it, "teleport('", 10) == "box 1 mouse target");
    CHECK(offer(it, "teleport('box", 10) == "box 1");
    CHECK(offer(it, "teleport('mouse', '", 19).empty());
    CHECK(offer(it, "explain 'c", 9) == "controller");
    CHECK(offer(it, "speed '", 7) == "max");
    CHECK(offer(it, "restart '", 9) == "anyway");
    CHECK(offer(it, "log_level \"", 11) == "debug error info warn");
    CHECK(offer(it, "deactivate 'c", 12) == "controller");
    CHECK(offer(it, "behavior 'x' { script = \"cou", 25) == "counter");
    CHECK(offer(it, "behavior 'x' { active = \"cou", 25).empty());
    CHECK(offer(it, "remove { name = \"", 17).empty());
}

TEST_CASE("ports are completed within the quotes of a word", "[console][completion]") {
    SessionRig it;
    CHECK(offer(it, "connect(\"contr", 9) == "controller.out");
    CHECK(offer(it, "connect('controller.out', 'm", 27) == "mouse.target_velocity_in");
    CHECK(offer(it, "watch \"controller.", 7) == "controller.in controller.out");
    CHECK(offer(it, "drive 'm", 7) == "mouse");
    CHECK(offer(it, "controller:use '", 16) == "fast slow");
    CHECK(offer(it, "help 'pa", 6) == "pause");
    CHECK(offer(it, "help 'co", 6) == "component connect controller");
    CHECK(offer(it, "print('contr", 7).empty());
}

TEST_CASE("completion reads the input as Lua does", "[console][completion]") {
    SessionRig it;
    SECTION("long brackets hold texts") {
        CHECK(offer(it, "watch [[contr", 8) == "controller.in controller.out");
        CHECK(offer(it, "connect([==[controller.out]==], [[m", 34) == "mouse.target_velocity_in");
        CHECK(offer(it, "x = [[\"]] cont", 10) == "controller");
        CHECK(offer(it, "x = [[ it's ]] cont", 15) == "controller");
        CHECK(offer(it, "controller[ [[in]] ].pe", 21) == "peers");
        CHECK(offer(it, "print [[\n\ncont", 8).empty());
    }
    SECTION("comments hold nothing") {
        CHECK(offer(it, "--[[ it's cont", 14).empty());
        CHECK(offer(it, "--[==[ ]] cont", 14).empty());
        CHECK(offer(it, "--[[ it's ]] cont", 13) == "controller");
        CHECK(offer(it, "-- it's\ncont", 8) == "controller");
        CHECK(offer(it, "x = '--' cont", 9) == "controller");
        CHECK(offer(it, "connect(--[[ ( ' ]]'controller.out', -- no, ', no\n 'm", 52) == "mouse.target_velocity_in");
    }
    SECTION("blanks and comments may stand between names") {
        CHECK(offer(it, "controller . config -- one\n. sp", 29) == "speed_x");
        CHECK(offer(it, "connect( f(1, 'a'), 'm", 21) ==
              "mouse.buzzer_hz_in mouse.led4bit_in mouse.pose_update mouse.target_velocity_in");
        CHECK(offer(it, "'controller'.", 13).empty());
        CHECK(offer(it, "x = { 'contr", 7).empty());
        CHECK(offer(it, "x = 'a\ncont", 7) == "controller");
    }
}
