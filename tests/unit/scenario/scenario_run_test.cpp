// One run: time, outcomes, errors that can't be caught, and the message for each kind of end.
#include <catch2/catch.hpp>

#include "tests/unit/scenario/scenario_rig.hpp"

using namespace nezumi;

TEST_CASE("a robot that touches a wall gives no warning", "[lua][scenario][run]") {
    const RunResult result = ScenarioRig(
                                 "scenario('it', function(s)\n"
                                 "  s:load 'systems/stop_at_wall.lua'\n"
                                 "  s:freeze('mouse.ir_sensor_out')\n"
                                 "  s:run(15) s:check(s.mouse.collided)\n"
                                 "end)")
                                 .run();
    CHECK(outcome_of(result) == "passed");
    CHECK(result.printed.empty());
}

TEST_CASE("each line of a scenario's output is a separate line", "[lua][scenario][run]") {
    const RunResult result = ScenarioRig("scenario('it', function() print('a\\n\\nb') print('') end)").run();
    CHECK(result.printed == std::vector<std::string>{"a", "", "b", ""});
}

TEST_CASE("worlds of different rates tick when they are due", "[lua][scenario][run]") {
    ScenarioRig rig(
        "scenario('it', function(s)\n"
        "  local slow, fast = s:load 'slow.lua', s:load 'fast.lua'\n"
        "  local looks = 0\n"
        "  s:always('counts', function() looks = looks + 1; return true end)\n"
        "  s:run(1)\n"
        "  s:check(looks == 100 + 8 - 4, tostring(looks))\n"  // every fourth of the slow ones is one of the fast
        "end)");
    static_cast<void>(rig.folder().write("slow.lua", "rate(8) physics { step = 0.005 } arena { size = { 1, 1 } }"));
    static_cast<void>(rig.folder().write("fast.lua", "rate(100) arena { size = { 1, 1 } }"));
    CHECK(outcome_of(rig.run()) == "passed");
}

TEST_CASE("a reload whose top level never ends ends the scenario with an error", "[lua][scenario][run][watchdog]") {
    for (const char* text : {"while true do end", "function on_reload() while true do end end"}) {
        const std::string outcome =
            outcome_of("s:load 'systems/stop_at_wall.lua'\ns:run(0.1)\ns:reload('controller', { text = \"" +
                       std::string(text) + "\" })\ns:run(0.1)");
        CHECK(outcome.starts_with("could not run: "));
        CHECK_THAT(outcome,
                   Catch::Contains(":1: ran for more than 2 s: is there an endless loop?; still running version 1"));
    }
}

TEST_CASE("a failure reports the difference, the ports that were read, and the time", "[lua][scenario][run]") {
    ScenarioRig rig(
        "scenario('it', function(s)\n"
        "  local w = s:load 'systems/stop_at_wall.lua'\n"
        "  s:never('turns', function() return w.controller.out.value.vx >= 0.1 end)\n"
        "  s:run(1)\n"
        "end)");
    const RunResult result = rig.run();
    CHECK(outcome_of(result) == "failed: it_test.lua:3: never 'turns' happened at 0.01 s");
    REQUIRE(result.facts.size() == 3);
    CHECK(result.facts[0] == "at 0.01 s of simulated time");
    CHECK(result.facts[1] == "w.controller.out.value.vx >= 0.1: w.controller.out.value.vx was 0.1 m/s");
    CHECK(result.facts[2].starts_with("  controller.out  TimedVelocity2D"));
}

TEST_CASE("a run reports the smallest margins of its conditions", "[lua][scenario][run]") {
    ScenarioRig rig(
        "scenario('it', function(s)\n"
        "  s:load 'systems/stop_at_wall.lua'\n"
        "  s:always('early', function() return s:now() < 1.25 end)\n"
        "  s:run(1)\n"
        "end)");
    CHECK(text_of(rig.run().margins.at(0)) ==
          "always 'early': came within 0.25 of the limit at 1.00 s (s:now() < 1.25)");
}

TEST_CASE("the margin of a hold that begins at its limit is measured afterwards", "[lua][scenario][run]") {
    const auto margins = [](const std::string& condition) {
        ScenarioRig rig(
            "scenario('it', function(s)\n  s:load 'systems/stop_at_wall.lua'\n  s:maintain('holds', { hold = 1 }, "
            "function() " +
            condition + " end)\nend)");
        return text_of(rig.run().margins.at(0));
    };
    // It grows from 0.005 on: only its end says something.
    CHECK(margins("return s:now() > 0.495") ==
          "maintain 'holds': came within 1.005 of the limit at 1.50 s (s:now() > 0.495)");
    // What holds from the first sample on has not crossed its limit.
    CHECK(margins("return s:now() > -0.25") ==
          "maintain 'holds': came within 0.26 of the limit at 0.01 s (s:now() > -0.25)");
}

TEST_CASE("s:equal compares deeply and shows both", "[lua][scenario][run]") {
    CHECK(outcome_of("s:equal(1, 1.0) s:equal('a', 'a') s:equal({}, {}) s:equal(nil, nil)\n"
                     "s:equal({ 1, { x = 2 } }, { 1, { x = 2 } })") == "passed");
    CHECK(outcome_of("s:equal({ a = { 1, 2 } }, { a = { 1, 3 } }, 'the list')") ==
          "failed: it_test.lua:2: equal failed: { a = { 1, 2 } } is not the expected { a = { 1, 3 } } (they differ at "
          "a[2]): the list");
    CHECK(outcome_of("s:equal({ 1 }, { 1, 2 })") ==
          "failed: it_test.lua:2: equal failed: { 1 } is not the expected { 1, 2 } (they differ at [2])");
    CHECK(outcome_of("s:equal(1, '1')") == "failed: it_test.lua:2: equal failed: 1 is not the expected \"1\"");
    CHECK(outcome_of("s:equal(1)") ==
          "could not run: it_test.lua:2: equal: expected two values, the actual one and the expected one");
    CHECK(outcome_of("local w = s:load 'systems/stop_at_wall.lua' s:run(0.1)\n"
                     "s:equal(w.controller.out.value, { vx = 0.1, vy = 0, va = 0 })") == "passed");
}
