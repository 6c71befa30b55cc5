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

TEST_CASE("every command refuses too many arguments and shows its usage", "[console][session]") {
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

TEST_CASE("every command is in the console's help once", "[console][session]") {
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

TEST_CASE("an interrupted run pauses", "[console][session]") {
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

TEST_CASE("pause, run and speed control the clock", "[console][session]") {
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
    CHECK(other.type("run()") ==
          "! run: expected seconds, as in run(1): in a batch of commands, time moves only by step(n) and run(seconds)");
}

TEST_CASE("exit is the same as quit, with or without brackets", "[console][session]") {
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

TEST_CASE("quit is answered before the run ends, unless the rest of the line does not end", "[console][session]") {
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

TEST_CASE("on hardware, commands about time are refused", "[console][session]") {
    SessionRig it;
    it.hardware = true;
    for (const char* text : {"step(1)", "run(1)", "speed(2)", "restart()"}) {
        CHECK_THAT(it.type(text), Contains("this works only in simulation: real robots always run in real time"));
    }
    CHECK(it.type("teleport(mouse, {})") ==
          "! teleport: real robots can't be teleported: this works only in simulation");
    it.type("run()");
    CHECK_FALSE(it.paused);
    it.type("pause()");
    CHECK(it.paused);
}

TEST_CASE("errors of an earlier start have its number", "[console][session]") {
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

TEST_CASE("a watch shows changes", "[console][session]") {
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

TEST_CASE("the arrow keys drive until Esc", "[console][session]") {
    SessionRig it;
    CHECK(it.type("drive 'mouse'") ==
          "at full deflection: 0.30 m/s, 3.0 rad/s\ndriving mouse.target_velocity_in: arrow keys, + and - scale, space "
          "stops, "
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
    CHECK_THAT(it.type("drive(controller.in)"), Contains("controller.in is TimedShortSeq: drive needs a port of"));
}

TEST_CASE("no line of a message looks like a line of the log", "[console][session]") {
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

TEST_CASE("a port that another actor holds is refused, and can be taken over", "[console][session][act]") {
    SessionRig it;
    const Actor tablet{Actor::Kind::browser, "tablet"};
    REQUIRE(it.live->act(Hold{"controller.out", Velocity2D{.vx = 0.1}}, tablet));
    CHECK_THAT(it.type("controller.out"), Contains("held by browser tablet"));
    CHECK(it.type("controller.out.holder") == "\"browser tablet\"");
    CHECK(
        it.type("hold(controller.out, {})") ==
        "! hold: controller.out is held by another user (browser tablet): hold(port, value, { take = true }) takes it");
    CHECK(it.type("hold(controller.out, {}, { take = 1 })") ==
          "! hold: controller.out: option 'take' expected true or false, got number");
    CHECK(it.type("hold(controller.out, {}, { tak = true })") ==
          "! hold: controller.out: unknown option 'tak' (did you mean 'take'?)");
    CHECK(it.type("controller.out:hold({}, true)") == "! controller.out: options expected a table, got boolean");
    CHECK(it.type("hold(controller.out, {}, { take = true })").empty());
    CHECK(it.type("controller.out.holder") == "\"console\"");
    CHECK(it.said("controller.out: its value is held by console now, no longer by browser tablet"));
    CHECK_FALSE(it.live->act(Release{"controller.out"}, tablet));
    CHECK(it.type("release(controller.out) return controller.out.holder") == "nil");
}

TEST_CASE("driving ends when another actor takes the port", "[console][session][act]") {
    SessionRig it(counter_system + "component 'stick' { type = 'Joystick' }\n");
    it.type("drive 'stick'");
    it.session->key(Key::up);
    it.turn(3);
    REQUIRE(it.live->act(Hold{"stick.stick", std::vector<float>{0, 0}, true}, {Actor::Kind::joystick}));
    it.shown.clear();
    it.session->key(Key::up);
    it.turn();
    CHECK(it.shown ==
          "driving has ended: stick.stick is held by another user (joystick): hold(port, value, { take = true }) "
          "takes it");
    CHECK_FALSE(it.keys);
}
