// What can be plotted at the prompt, together and again and again.
#include <catch2/catch.hpp>

#include <string>

#include "bindings/console/input_text.hpp"
#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;

namespace {

const std::string talker = R"(
local mode = output("mode", "TimedString", "")
local blocked = output("blocked", "TimedBoolean", "")
param("gain", 1.0)
state.n = 0
function on_execute()
  state.n = state.n + 1
  probe("count", state.n)
  mode:write(state.n > 5 and "fast" or "slow")
  blocked:write(state.n > 3)
end
)";

struct PlotRig : SessionRig {
    PlotRig()
        : SessionRig(counter_system + "behavior \"talker\" { script = \"talker\" }\n",
                     {{"counter", counter_behavior}, {"talker", talker}}) {}
};

}  // namespace

TEST_CASE("probes are plotted by their names", "[console][plot]") {
    PlotRig it;
    it.turn(1);
    CHECK(it.type("plot(talker.probes.count)") ==
          "talker.probes.count\ncount = 1 at 0 s, the only value that is remembered");
    CHECK(it.type("plot 'talker.probes.cuont'") == "! plot: talker.probes has no 'cuont' (did you mean 'count'?)");
    CHECK_THAT(it.type("plot(mouse.probes)"), StartsWith("! plot: mouse has no port 'probes'"));
    CHECK(it.type("plot(talker.probes)") == "talker.probes\ncount = 1 at 0 s, the only value that is remembered");
    it.turn(20);
    CHECK_THAT(it.type("plot(talker.probes.count, 5)"), StartsWith("talker.probes.count\ncount\n21 │"));
    CHECK_THAT(it.type("plot(talker.probes.count, controller.out.vx, 5)"),
               Contains("* talker.probes.count   o controller.out.vx"));
}

TEST_CASE("a plot is drawn repeatedly until unwatch or Ctrl-C", "[console][plot]") {
    PlotRig it;
    it.type("plot(controller.out, 1, { every = 0.2 })");
    int drawn = 0;
    for (int tick = 0; tick < 41; ++tick) {
        it.shown.clear();
        it.turn();
        if (it.shown.find("controller.out") != std::string::npos) ++drawn;
    }
    CHECK(drawn == 2);
    SECTION("unwatch") { it.type("unwatch()"); }
    SECTION("Ctrl-C") { it.session->interrupt(); }
    it.shown.clear();
    it.turn(50);
    CHECK(it.shown.empty());
}

TEST_CASE("a plot ends when its port is removed, and reports it once", "[console][plot]") {
    PlotRig it;
    it.type("plot(talker.mode, { every = 0.1 }) remove 'talker'");
    it.shown.clear();
    it.turn(30);
    CHECK_THAT(it.shown, Contains("there is no component 'talker'") && Contains(": no longer drawn"));
    it.shown.clear();
    it.turn(30);
    CHECK(it.shown.empty());
}

TEST_CASE("plot takes the name of its argument, not its value", "[console][plot][input]") {
    const auto text = [](const std::string& given) { return with_plotted_names(given); };
    CHECK(text("plot(controller.out.vx, 5)") == "plot({ controller, \".out.vx\" }, 5)");
    CHECK(text("plot(a.out.value.vx, m.truth.pose.heading)") ==
          "plot({ a, \".out.value.vx\" }, { m, \".truth.pose.heading\" })");
    CHECK(text("plot(mouse.ir_sensor_out[2], a.in.x, { every = 1 })") ==
          "plot({ mouse, \".ir_sensor_out[2]\" }, { a, \".in.x\" }, { every = 1 })");
    CHECK(text("plot(a.out['vx'], a[\"in\"], p[1])") == "plot({ a, \".out.vx\" }, a[\"in\"], { p, \"[1]\" })");
    CHECK(text("plot(a.probes, a.truth, a.collided)") ==
          "plot({ a, \".probes\" }, { a, \".truth\" }, { a, \".collided\" })");
    CHECK(text("for i = 1, 2 do plot(a . \n b.c) end") == "for i = 1, 2 do plot({ a, \".b.c\" }\n) end");
    for (const std::string same : {"plot(a.out, 5)", "plot 'a.out.vx'", "x.plot(a.b.c)", "x:plot(a.b.c)",
                                   "'plot(a.b.c)' -- plot(a.b.c)", "plot(f(a.b.c))", "plot(a.b.c + 1)", "plot(a.b[i])",
                                   "plot(", "plot(a.b.c", "plot(a.b.", "plot(a.b.)", "plot"}) {
        CHECK(text(same) == same);
    }
}

TEST_CASE("a probe is plotted with or without .value, and the error of a wrong name has the nearest",
          "[console][plot]") {
    PlotRig it;
    it.turn(1);
    it.type("t = talker plot(talker.probes)");
    for (const std::string name :
         {"talker.probes.count", "talker.probes.count.value", "'talker.probes.count.value'", "t.probes['count'].value"})
        CHECK(it.type("plot(" + name + ")") ==
              "talker.probes.count\ncount = 1 at 0 s, the only value that is remembered");
    CHECK(it.type("plot(t.probes.cuont.value)") == "! plot: talker.probes has no 'cuont' (did you mean 'count'?)");
}

TEST_CASE("collided of a robot can be plotted", "[console][plot]") {
    PlotRig it;
    it.turn(1);
    CHECK(it.type("plot(mouse.collided)") == "mouse.collided\nvalue = 0 at 0 s, the only value that is remembered");
    CHECK(it.type("plot('mouse.collided.by')") == "! plot: mouse.collided is a single value: it has no 'by'");
    CHECK(it.type("plot(talker.collided)") == "! plot: talker has no collided: it is not a robot");
}

TEST_CASE("every value of the console can be plotted", "[console][plot]") {
    SessionRig it;
    it.type("step(1)");
    CHECK(it.type("plot('mouse.buzzer')") == "mouse.buzzer\nvalue = 0 at 0 s, the only value that is remembered");
    CHECK(it.type("plot(mouse.limits.speed)") ==
          "mouse.limits.speed\nspeed = 0.5 at 0 s, the only value that is remembered");
    CHECK(it.type("plot('controller.status')") == "controller.status\nvalue: \"ACTIVE\" from 0 s");
    CHECK(it.type("plot(controller.out.count)") ==
          "controller.out.count\nvalue = 1 at 0 s, the only value that is remembered");
    CHECK(it.type("plot('mouse.teleport')") == "! plot: mouse has no port 'teleport'");
}
