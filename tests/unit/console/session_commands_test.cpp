// The words of the console, one after the other.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <set>
#include <string>
#include <string_view>

#include "bindings/console/console_commands.hpp"
#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("step and run return when time has moved", "[console][session]") {
    SessionRig it;
    CHECK(it.type("step(3) return now()") == "0.03");
    CHECK(it.paused);
    CHECK(it.type("run(0.5) return now()") == "0.53");
    CHECK(it.type("step() return now()") == "0.54");
    CHECK(it.type("for i = 1, 3 do step(2) end return now()") == "0.6");
    CHECK(it.type("coroutine.wrap(function() run(0.1) end)() return now()") == "0.7");
    CHECK(it.type("pcall(run, 0.1) return now()") == "0.8");
    CHECK(it.type("step(0)") == "! step: expected a whole number of ticks from 1 to 1000000000000, got 0");
    CHECK(it.type("step(1.5)") == "! step: expected a whole number of ticks from 1 to 1000000000000, got 1.5");
    CHECK(it.type("run(-1)") == "! run: expected seconds, more than 0, got -1");
    CHECK(it.type("run(1e300)") == "! run: expected a whole number of ticks from 1 to 1000000000000, got 1e+302");
    CHECK(it.type("run('x')") == "! run: expected seconds, got string");
    CHECK(it.type("step(1, 2)") == "! step: expected at most 1 argument, got 2: step(n)");
}

TEST_CASE("every word refuses an argument too many, and says how it is used", "[console][session]") {
    SessionRig it;
    for (const ConsoleCommand& command : console_commands()) {
        std::string call = std::string(command.name) + "(nil";
        for (int i = 0; i < command.most; ++i) call += ", nil";
        const std::string most = command.most == 0
                                     ? "no arguments"
                                     : fmt::format("at most {} argument{}", command.most, command.most == 1 ? "" : "s");
        CHECK(it.type(call + ")") ==
              fmt::format("! {}: expected {}, got {}: {}", command.name, most, command.most + 1, command.usage));
    }
    CHECK_FALSE(it.quitting);
}

TEST_CASE("every word is in the console's help once", "[console][session]") {
    std::set<std::string_view> names;
    for (const ConsoleCommand& command : console_commands()) {
        CAPTURE(command.name);
        CHECK(names.insert(command.name).second);
    }
}

TEST_CASE("ls lists the first forty components and says how many more there are", "[console][session]") {
    std::string system = counter_system;
    for (int i = 0; i < 50; ++i) system += fmt::format("\nbehavior 'b{}' {{ script = 'counter' }}", i);
    SessionRig it(system);
    const std::string listed = it.type("ls()");
    const std::size_t others = it.live->system().components().size() - 40;
    CHECK_THAT(listed, Catch::EndsWith(fmt::format("\nand {} more: ls \"name\" shows one", others)));
}

TEST_CASE("a run can be interrupted, which pauses", "[console][session]") {
    SessionRig it;
    it.session->submit("run(100)");
    while (!it.session->is_waiting()) it.session->advance();
    it.turn(5);
    CHECK(it.session->is_waiting());
    it.session->interrupt();
    CHECK(it.paused);
    CHECK_FALSE(it.session->is_busy());
    CHECK(it.type("now()") == "0.05");
}

TEST_CASE("pause, run without end and speed go to the clock", "[console][session]") {
    SessionRig it;
    it.type("run()");
    CHECK_FALSE(it.paused);
    it.type("pause()");
    CHECK(it.paused);
    it.type("speed(2.5)");
    CHECK(it.type("speed()") == "2.5");
    it.type("speed 'max'");
    CHECK(std::isinf(it.factor_));
    CHECK(it.type("speed(0)") ==
          "! speed: expected a factor from 0.001 to 1000000, or \"max\", got 0; pause() stops time");
    CHECK(it.type("speed(5e-324)") == "! speed: expected a factor from 0.001 to 1000000, or \"max\", got 5e-324");
    CHECK(it.type("speed(1e300)") == "! speed: expected a factor from 0.001 to 1000000, or \"max\", got 1e+300");
    CHECK(std::isinf(it.factor_));
    CHECK(it.type("speed('fast')") == "! speed: expected a number or \"max\", got string");
    SessionOptions batch;
    batch.batch = true;
    SessionRig other(counter_system, {{"counter", counter_behavior}}, batch);
    CHECK(other.type("run()") == "! run: how long? Time moves only by step(n) and run(seconds) here");
}

TEST_CASE("exit is quit, with its brackets and without", "[console][session]") {
    for (const char* text : {"quit()", "exit()", "quit", " exit ", "exit\n"}) {
        INFO(text);
        SessionRig it;
        it.type(text);
        CHECK(it.quitting);
    }
    SessionRig it;
    CHECK(it.type("exits") == "! unknown name 'exits' (did you mean 'exit'?)");
    it.type("(exit)");
    CHECK_FALSE(it.quitting);
}

TEST_CASE("whoever ends a run is answered before, unless the rest of the line goes on", "[console][session]") {
    SessionRig it;
    it.type("quit()");
    CHECK(it.quitting);
    CHECK(it.finished_at_quit == 1);

    SessionRig endless;
    endless.session->submit("quit() while true do end");
    for (int rounds = 0; !endless.quitting && rounds < 100'000; ++rounds) endless.session->advance();
    CHECK(endless.quitting);
    CHECK(endless.finished_at_quit == 0);
    endless.session->interrupt();

    SessionRig gone;
    gone.session->submit("quit() while true do end");
    for (int rounds = 0; gone.session->is_busy() && rounds < 20; ++rounds) gone.session->advance();
    gone.session->close();
    CHECK(gone.quitting);
}

TEST_CASE("on hardware only real time is offered", "[console][session]") {
    SessionRig it;
    it.hardware = true;
    for (const char* text : {"step(1)", "run(1)", "speed(2)", "restart()"}) {
        CHECK_THAT(it.type(text), Contains("real robots know only real time: this works in simulation"));
    }
    it.type("run()");
    CHECK_FALSE(it.paused);
    it.type("pause()");
    CHECK(it.paused);
}

TEST_CASE("errors of an earlier start say so: their clock is another", "[console][session]") {
    SessionRig it;
    it.type("step(12)");
    it.component("controller").abort(Error{"it broke", {}});
    CHECK_THAT(it.type("errors()"), StartsWith("[0.120] error controller: it broke\n"));
    it.type("restart() step(2)");
    CHECK(it.type("errors()") == "[start 1, 0.120] error controller: it broke");
    it.component("controller").abort(Error{"again", {}});
    CHECK(it.type("errors()") ==
          "[start 1, 0.120] error controller: it broke\n[0.020] error controller: again\n"
          "controller is in ERROR: again");
}

TEST_CASE("a watch shows changes as they come", "[console][session]") {
    SessionOptions every;
    every.watch_period = 0;
    SessionRig it(counter_system, {{"counter", counter_behavior}}, every);
    CHECK(it.type("watch(controller.out) step(3)") == "[0.000] controller.out = { vx = 0.25, vy = 0, va = 0 }");
    CHECK(it.type("controller.config.speed_x = 0.5 step(2)") ==
          "[0.030] controller.out = { vx = 0.5, vy = 0, va = 0 }");
    CHECK(it.type("unwatch(controller.out) controller.config.speed_x = 0.25 step(2)").empty());
    CHECK(it.type("unwatch(controller.out)") == "! unwatch: controller.out is not watched");
    it.type("watch(controller.out) step()");
    CHECK(it.type("unwatch() controller.config.speed_x = 0.5 step(2)").empty());
    CHECK(it.type("watch(controller)") ==
          "! watch: expected a port, got the component controller: write controller.PORT");
}

TEST_CASE("a plot draws what a port carried", "[console][session]") {
    SessionRig it;
    CHECK(it.type("plot(controller.out, 5)") == "controller.out has carried nothing in this time that can be drawn");
    it.type("step(10) controller.config.speed_x = 0.5 step(10)");
    const std::string plot = it.type("plot(controller.out, 5)");
    CHECK_THAT(plot, StartsWith("controller.out\nvx\n 0.5 │"));
    CHECK_THAT(plot, Contains("\n0.25 │⣀") && Contains("vy = 0 all the time") && Contains("0 s") && Contains("0.2 s"));
    CHECK(it.type("plot(controller.out, 0)") == "! plot: expected seconds, more than 0, got 0");
}

TEST_CASE("the arrow keys drive until Esc", "[console][session]") {
    SessionRig it;
    CHECK(it.type("drive 'mouse'") ==
          "at the edge: 0.30 m/s, 3.0 rad/s\ndriving mouse.target_velocity_in: arrow keys, + and - scale, space stops, "
          "Esc "
          "ends");
    CHECK(it.keys);
    it.session->key(Key::up);
    it.session->key(Key::up);
    it.session->key(Key::left);
    it.turn(2);
    const auto velocity = [&] { return it.type("mouse.target_velocity_in.value"); };
    CHECK(velocity() == "{ va = 1.0, vx = 0.2, vy = 0.0 }");
    it.session->key(Key::down);
    it.turn(2);
    CHECK(velocity() == "{ va = 1.0, vx = 0.0, vy = 0.0 }");
    it.turn(80);
    CHECK(velocity() == "{ va = 0.0, vx = 0.0, vy = 0.0 }");
    it.session->key(Key::escape);
    CHECK_FALSE(it.keys);
    it.turn(3);
    CHECK(velocity() == "{ va = 0.0, vx = 0.25, vy = 0.0 }");  // the controller's again
    CHECK(it.type("drive 'muose'") == "! drive: there is no component 'muose' (did you mean 'mouse'?)");
    CHECK_THAT(it.type("drive(controller.in)"), Contains("controller.in is TimedShortSeq: a stick drives"));
}

TEST_CASE("a marker is carried by hand, a robot as well", "[console][session]") {
    SessionRig it(
        "arena { marker { name = 'target', id = 7, size = 0.1, at = { 1.0, 0.0, 0.06 }, facing = math.pi } }\n"
        "robot 'mouse' { model = 'raspimouse' }\n",
        {});
    const auto marker = [&it] { return it.live->system().world()->markers().front().pose; };
    CHECK(it.type("teleport('target', { x = 1.2, heading = 0.5 })").empty());
    CHECK(marker().position == Point3D{1.2, 0.0, 0.06});
    CHECK(marker().orientation.y == 0.5);
    CHECK(it.type("teleport(mouse, { x = 0.3 }) return mouse.truth.pose.position.x") == "0.3");
    CHECK(it.type("teleport('mouse', { x = 0.4 }) return mouse.truth.pose.position.x") == "0.4");
    CHECK(it.type("teleport('targt', { x = 1 })") == "! teleport: there is no marker 'targt' (did you mean 'target'?)");
    CHECK(it.type("teleport('mose', {})") == "! teleport: there is no component 'mose' (did you mean 'mouse'?)");
    CHECK(it.type("teleport('target', { hight = 1 })") ==
          "! teleport: pose: unknown field 'hight': expected x, y, z, heading");
    CHECK(it.type("teleport('target')") ==
          "! teleport: pose: expected a table { x =, y =, z =, heading = }, got nothing");
    CHECK(it.type("ls(mouse.ir_sensor_out)") == "! ls: expected a component or its name, got a port");
    CHECK_THAT(it.type("teleport()"), StartsWith("! teleport: expected a marker or robot"));
    it.hardware = true;
    CHECK(it.type("teleport('target', {})") == "! teleport: real robots stay where they are: this works in simulation");
    const auto items = it.complete("teleport('").candidates;
    CHECK(items == std::vector<std::string>{"mouse", "target"});
}

TEST_CASE("no line of a message can be taken for a line of the log", "[console][session]") {
    SessionRig it(counter_system, {{"counter", R"(
input("in", "TimedShortSeq", "numbers") output("out", "TimedVelocity2D", "velocity")
param("speed_x", 1.0)
function on_execute()
  state.n = (state.n or 0) + 1
  if state.n == 1 then log.warn("w\n[   9.000] error forged") end
  if state.n == 2 then error("e\n[   9.000] error forged") end
end
)"}});
    it.turn(3);
    const std::string errors = it.type("errors()");
    CHECK_THAT(errors, Contains("controller: w\n") && Contains("controller is in ERROR: "));
    CHECK_THAT(errors, Contains("error forged") && !Contains("\n[   9.000] error forged"));
}

TEST_CASE("a hold that is another's is refused, and can be taken", "[console][session][act]") {
    SessionRig it;
    const Actor tablet{Actor::Kind::browser, "tablet"};
    REQUIRE(it.live->act(Hold{"controller.out", Velocity2D{.vx = 0.1}}, tablet));
    CHECK_THAT(it.type("controller.out"), Contains("held by browser tablet"));
    CHECK(it.type("controller.out.holder") == "\"browser tablet\"");
    CHECK(it.type("hold(controller.out, {})") ==
          "! hold: controller.out is held by another (browser tablet): hold(port, value, { take = true }) takes it");
    CHECK(it.type("hold(controller.out, {}, { take = 1 })") ==
          "! hold: controller.out: option 'take' expected true or false, got number");
    CHECK(it.type("hold(controller.out, {}, { tak = true })") ==
          "! hold: controller.out: unknown option 'tak' (did you mean 'take'?)");
    CHECK(it.type("controller.out:hold({}, true)") == "! controller.out: options expected a table, got boolean");
    CHECK(it.type("hold(controller.out, {}, { take = true })").empty());
    CHECK(it.type("controller.out.holder") == "\"console\"");
    CHECK(it.said("controller.out: held by console from now on, no longer by browser tablet"));
    CHECK_FALSE(it.live->act(Release{"controller.out"}, tablet));
    CHECK(it.type("release(controller.out) return controller.out.holder") == "nil");
}

TEST_CASE("stop() and rearm() are words", "[console][session][act]") {
    SessionRig it;
    CHECK(it.type("rearm()") == "! rearm: nothing is stopped: rearm() follows stop()");
    CHECK(it.type("run(1) stop() run(1) return mouse.truth.velocity.vx < 0.001").find("true") == 0);
    CHECK(it.said("emergency stop (console): rearm() lets the robots drive again"));
    for (const char* look : {"mouse.target_velocity_in", "ls(mouse)"})
        CHECK_THAT(it.type(look), Contains("  (emergency stop: commands are ignored until rearm())"));
    CHECK(it.type("rearm() run(1) return mouse.truth.velocity.vx > 0.2").find("true") == 0);
}

TEST_CASE("what another takes is no longer driven", "[console][session][act]") {
    SessionRig it(counter_system + "component 'stick' { type = 'Joystick' }\n");
    it.type("drive 'stick'");
    it.session->key(Key::up);
    it.turn(3);
    REQUIRE(it.live->act(Hold{"stick.stick", std::vector<float>{0, 0}, true}, {Actor::Kind::joystick}));
    it.shown.clear();
    it.session->key(Key::up);
    it.turn();
    CHECK(it.shown ==
          "driving has ended: stick.stick is held by another (joystick): hold(port, value, { take = true }) "
          "takes it");
    CHECK_FALSE(it.keys);
}
