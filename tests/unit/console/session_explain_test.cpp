// The console explains an execution.
#include <catch2/catch.hpp>

#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;

TEST_CASE("the console explains the next execution of a behaviour, once", "[console][explain]") {
    SessionRig it;
    it.paused = false;
    it.session->submit("explain(controller)");
    for (int i = 0; i < 1000; ++i) it.session->advance();
    CHECK(it.shown.empty());
    CHECK(it.session->is_busy());  // who asked by --eval leaves when it is told
    it.turn();
    CHECK_FALSE(it.session->is_busy());
    CHECK(it.shown.find("controller at ") == 0);
    CHECK(it.shown.find("controller.out -> ") < it.shown.find("controller.in <- "));
    CHECK(it.shown.find("controller.in <- mouse.ir_sensor_out") != std::string::npos);
    CHECK(it.shown.find("mouse's wheels") != std::string::npos);
    it.shown.clear();
    it.turn(3);
    CHECK(it.shown.empty());
}

TEST_CASE("the console reports why it can't explain a component, or that time is paused", "[console][explain]") {
    SessionRig it;
    CHECK(it.type("explain(mouse)") == "! explain: mouse is not a behaviour: it has no lines");
    CHECK(it.type("explain()") == "! explain: expected a behaviour, as in explain(controller), got nothing");
    CHECK(it.type("explain(controller)") == "time is paused: step() lets it execute");
    it.type("restart()");
    it.shown.clear();
    it.turn();
    CHECK(it.shown == "controller was replaced by a restart or a seek: not explained");
}

TEST_CASE("what robots and devices cost a tick is measured as well", "[console][profile]") {
    SessionRig it(
        "robot 'mouse' { model = 'raspimouse' }\ncomponent 'stick' { type = 'Joystick' }\n"
        "behavior 'idle' { script = 'idle' }\n",
        {{"idle", "function on_execute() state.n = 1 end\n"}});
    CHECK(it.type("profile(0.1)") == "time is paused: run() lets it go on");
    it.shown.clear();
    it.turn(10);
    CHECK(it.shown.find("component  executions      median       worst  mean/tick\n") == 0);
    for (const std::string name : {"mouse", "stick", "idle "}) {
        INFO(it.shown);
        CHECK(it.shown.find("\n" + name + "              10  ") != std::string::npos);
    }
    for (const Component* component : std::as_const(*it.live).system().components())
        CHECK(component->tick_costs() == nullptr);
}

TEST_CASE("on real robots a breakpoint shows executions without stopping, at most one a second", "[console][explain]") {
    SessionRig it(counter_system, {{"counter", counter_behavior}}, {}, disk(), true);
    it.paused = false;
    CHECK(it.type("break_at(\"counter.lua:13\", function(locals) return locals.state == nil end)") ==
          "traces counter.lua:13: for _, value in ipairs(range:read()) do   (unwatch() ends it)");
    it.shown.clear();
    const std::uint64_t moves = it.moves();
    it.turn(250);
    CHECK_FALSE(it.paused);
    CHECK(it.moves() == moves);
    CHECK(it.live->system().now().seconds == Approx(2.5));
    std::size_t shown = 0;
    for (std::size_t at = it.shown.find("counter.lua:13 ran at "); at != std::string::npos;
         at = it.shown.find("counter.lua:13 ran at ", at + 1))
        ++shown;
    CHECK(shown == 3);
    CHECK(it.shown.find("paused") == std::string::npos);
    CHECK(it.shown.find("controller.out -> ") != std::string::npos);
    it.type("unwatch()");
    it.shown.clear();
    it.turn(150);
    CHECK(it.shown.empty());
}
