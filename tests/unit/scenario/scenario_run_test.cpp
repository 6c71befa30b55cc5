// One run: time, outcomes, what can't be caught, and what is said of each way to end.
#include <catch2/catch.hpp>

#include "tests/unit/scenario/scenario_rig.hpp"

using namespace nezumi;

TEST_CASE("time moves by run and by waiting, and by nothing else", "[lua][scenario][run]") {
    CHECK(outcome_of("s:load 'systems/stop_at_wall.lua'\n"
                     "s:check(s:now() == 0) s:run(1.5) s:near(s:now(), 1.5, 1e-9)\n"
                     "s:run(0.005) s:near(s:now(), 1.5, 1e-9) s:run(0.005) s:near(s:now(), 1.51, 1e-9)\n"
                     "s:wait_until('so already', { within = 0 }, function() return true end)\n"
                     "s:near(s:now(), 1.51, 1e-9)\n"
                     "s:maintain('a second', { hold = 1, within = 0 }, function() return true end)\n"
                     "s:near(s:now(), 2.51, 1e-9)") == "passed");
}

TEST_CASE("conditions are looked at after every tick", "[lua][scenario][run]") {
    CHECK(outcome_of("s:load 'systems/stop_at_wall.lua'\n"
                     "local looks = 0\n"
                     "s:always('counts', function() looks = looks + 1; return true end)\n"
                     "s:check(looks == 0) s:run(1) s:check(looks == 100, tostring(looks))") == "passed");
}

TEST_CASE("an always that no tick comes after is looked at once, at the end", "[lua][scenario][run]") {
    CHECK(outcome_of("s:load 'systems/stop_at_wall.lua'\n"
                     "s:run(1) s:always('no', function() return false end)") ==
          "failed: it_test.lua:3: always 'no' did not hold at its first sample, at 1.00 s");
    CHECK(outcome_of("s:load 'systems/stop_at_wall.lua'\n"
                     "s:never('yes', function() return true end)") ==
          "failed: it_test.lua:3: never 'yes' happened at 0.00 s");
    CHECK(outcome_of("s:load 'systems/stop_at_wall.lua'\n"
                     "s:always('yes', function() return s:now() == 0 end)") == "passed");
}

TEST_CASE("a scenario can't declare another one", "[lua][scenario][run]") {
    CHECK(outcome_of("scenario('inner', function() end)") ==
          "could not run: it_test.lua:2: scenario: scenarios are declared by the file, not by one another");
}

TEST_CASE("a robot that drives against a wall is no news to be warned of", "[lua][scenario][run]") {
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

TEST_CASE("each line of what a scenario prints is a line of its own", "[lua][scenario][run]") {
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

TEST_CASE("a broken always ends the scenario at once, whatever tries to catch it", "[lua][scenario][run][watchdog]") {
    CHECK(outcome_of("s:load 'systems/stop_at_wall.lua'\n"
                     "s:always('rests', function() return s:now() < 0.5 end)\n"
                     "pcall(function() coroutine.wrap(function() pcall(s.run, s, 1) end)() end)\n"
                     "while true do pcall(error) end") ==
          "failed: it_test.lua:3: always 'rests' held until 0.49 s and ceased at 0.50 s");
}

TEST_CASE("a scenario that takes longer than its timeout fails", "[lua][scenario][run]") {
    ScenarioRig rig(
        "scenario('it', { timeout = 2 }, function(s)\n"
        "  s:load 'systems/stop_at_wall.lua'\n"
        "  s:run(2)\n"
        "  s:wait_until('more', function() return false end)\n"
        "end)");
    CHECK(outcome_of(rig.run()) ==
          "failed: it_test.lua:4: timeout: the scenario takes longer than 2.00 s of simulated time; "
          "wait_until 'more' had not happened since 2.00 s");
}

TEST_CASE("a reload that never ends its loading ends the scenario: it could not be run",
          "[lua][scenario][run][watchdog]") {
    for (const char* text : {"while true do end", "function on_reload() while true do end end"}) {
        const std::string outcome =
            outcome_of("s:load 'systems/stop_at_wall.lua'\ns:run(0.1)\ns:reload('controller', { text = \"" +
                       std::string(text) + "\" })\ns:run(0.1)");
        CHECK(outcome.starts_with("could not run: "));
        CHECK_THAT(outcome,
                   Catch::Contains(":1: ran for more than 2 s: is there an endless loop?; still running version 1"));
    }
}

TEST_CASE("an endless loop ends with its line, and the scenario could not be run", "[lua][scenario][run][watchdog]") {
    CHECK(outcome_of("while true do end") ==
          "could not run: it_test.lua:2: ran for more than 2 s: is there an endless loop?");
    CHECK(outcome_of("s:load 'systems/stop_at_wall.lua'\n"
                     "s:always('it', function()\n while true do end end)\n"
                     "pcall(s.run, s, 1)") ==
          "could not run: it_test.lua:4: always 'it': ran for more than 2 s: is there an endless loop?");
}

TEST_CASE("what the worlds and conditions use does not count for the scenario", "[lua][scenario][run]") {
    // Each condition takes a while; together they take longer than the scenario's own budget.
    CHECK(outcome_of("s:load 'systems/stop_at_wall.lua'\n"
                     "s:always('slow', function() for i = 1, 3000000 do end return true end)\n"
                     "s:run(1)") == "passed");
}

TEST_CASE("errors of a scenario name its line", "[lua][scenario][run]") {
    CHECK(outcome_of("error('so')") == "failed: it_test.lua:2: so");
    CHECK(outcome_of("local w = s:load 'systems/stop_at_wall.lua'\nreturn w.mouze") ==
          "failed: it_test.lua:3: there is no component 'mouze' (did you mean 'mouse'?)");
    CHECK(outcome_of("s:load 'systems/stop_at_wall.lua'\nlocal it = s.rum") ==
          "could not run: it_test.lua:3: s has no 'rum' (did you mean 'run'?)");
    CHECK(
        outcome_of("s:run(1)") ==
        "could not run: it_test.lua:2: s.run: there is no world yet: s:load a system, or say s:robot, s:behavior ...");
    CHECK(outcome_of("s:load 'systems/stop_at_wall.lua'\ns.run(1)") ==
          "could not run: it_test.lua:3: write s:run(...) with a colon");
    CHECK(outcome_of("s:load 'systems/stop_at_wall.lua'\ns:run(-1)") ==
          "could not run: it_test.lua:3: run: expected seconds from 0 on, got -1");
    CHECK(outcome_of("s:check(1 == 2, 'no')") == "failed: it_test.lua:2: check failed: no");
    CHECK(outcome_of("s:check(1 == 2, 'n\\0o')") == "failed: it_test.lua:2: check failed: n?o");
    CHECK(outcome_of("s:near(1, 2, 0.5, 'n\\0o')").ends_with(": n?o"));
    CHECK(outcome_of("s:near(1, 2, 0.5)") ==
          "failed: it_test.lua:2: near failed: 1 is off 2 by 1, more than the tolerance of 0.5");
    CHECK(outcome_of("s:near(0/0, 2, 0.5, 'speed')") ==
          "failed: it_test.lua:2: near failed: the actual value is not a number: speed");
    CHECK(outcome_of("s:near(1, 0/0, 0.5)") ==
          "failed: it_test.lua:2: near failed: the expected value is not a number");
    CHECK(outcome_of("s:near(1/0, 1/0, 0)") == "passed");
    CHECK_THAT(outcome_of("s:near(1/0, -1/0, 0)"), Catch::Contains("near failed: inf is off -inf by inf"));
}

TEST_CASE("options of an expectation are checked", "[lua][scenario][run]") {
    const auto with = [](const std::string& line) { return outcome_of("s:load 'systems/stop_at_wall.lua'\n" + line); };
    CHECK(
        with("s:maintain('m', { within = 1 }, function() return true end)") ==
        "could not run: it_test.lua:3: maintain: 'm': option 'hold' is missing: expected a number from 0 on in s: the "
        "condition must stay true so long");
    CHECK(with("s:eventually('e', { witin = 1 }, function() return true end)") ==
          "could not run: it_test.lua:3: eventually: 'e': unknown option 'witin' (did you mean 'within'?)");
    CHECK(with("s:eventually('e', { within = 'x' }, function() return true end)") ==
          "could not run: it_test.lua:3: eventually: 'e': option 'within' expected a number from 0 on, got string");
    CHECK(with("s:always('a', { within = 1 }, function() return true end)") ==
          "could not run: it_test.lua:3: always: 'a': unknown option 'within': there are no options here");
    CHECK(with("s:always('a', true)") ==
          "could not run: it_test.lua:3: always: 'a': expected options (a table) or a function, got boolean");
    CHECK(with("s:always(function() return true end)") ==
          "could not run: it_test.lua:3: always: expected a name (what should hold), got function");
}

TEST_CASE("a system that can't be built could not be run, unless the scenario expects that", "[lua][scenario][run]") {
    CHECK(outcome_of("s:load 'no_such'")
              .starts_with("could not run: it_test.lua:2: load: there is no system file 'no_such'"));
    CHECK(outcome_of("s:robot 'mouse' { model = 'raspimous' }\ns:run(1)")
              .starts_with("could not run: it_test.lua:2:19: robot 'mouse': there is no robot model 'raspimous'"));
    CHECK(
        outcome_of("s:robot 'mouse' { model = 'raspimouse' }\ns:connect('mouse.nothing', 'mouse.target_velocity_in')\n"
                   "s:run(1)")
            .starts_with("could not run: it_test.lua:3: "));
    CHECK(outcome_of("s:check(not pcall(s.load, s, 'no_such'))") == "passed");
}

TEST_CASE("words add to a world that runs, and an arena to one that does not yet", "[lua][scenario][run]") {
    CHECK(outcome_of("local w = s:load 'systems/stop_at_wall.lua'\n"
                     "w.controller.config.speed_x = 0.3\n"
                     "s:arena { s:box { at = { 0.4, 0, 0.15 }, size = { 0.1, 1, 0.3 } } }\n"
                     "s:run(0.2) s:near(w.controller.out.value.vx, 0.3, 0)\n"
                     "s:robot 'second' { model = 'raspimouse', pose = { y = 1 } }\n"
                     "s:connect('controller.out', 'second.target_velocity_in')\n"
                     "s:run(9)\n"
                     "s:check(w.mouse.truth.pose.position.x < 0.35) s:check(s.second.truth.pose.position.x > 0.01)") ==
          "passed");
    CHECK(outcome_of("s:load 'systems/stop_at_wall.lua'\ns:run(1)\n"
                     "s:arena { s:box { at = { 0.4, 0, 0.15 }, size = { 0.1, 1, 0.3 } } }\ns:run(1)")
              .find("arena: can't change once time has moved") != std::string::npos);
}

TEST_CASE("a word for a component returns it, whether its world is built or not", "[lua][scenario][run]") {
    CHECK(outcome_of(
              "local mouse = s:robot 'mouse' { model = 'raspimouse' }\n"
              "local driver = s:behavior('driver', { script = 'robot_controller', config = { speed_x = 0.1 } })\n"
              "s:connect('driver.out', 'mouse.target_velocity_in')\n"
              "s:run(1)\n"
              "s:check(mouse == s.mouse and driver == s.world.driver)\n"
              "s:near(driver.out.value.vx, 0.1, 0)\n"
              "s:check(mouse.truth.pose.position.x > 0.05)\n"
              "s:reload(driver, { text = 'function on_execute() end' }) s:check(driver.version == 2)") == "passed");
    CHECK(outcome_of("local mouse = s:robot 'mouse' { model = 'raspimouse', pose = { y = 1 } }\n"
                     "s:near(mouse.truth.pose.position.y, 1, 1e-9)") == "passed");
    CHECK(outcome_of("local second = s:robot 'second' { model = 'raspimouse', pose = { y = 1 } }\n"
                     "local world = s:load 'systems/stop_at_wall.lua'\n"
                     "local third = s:robot 'third' { model = 'raspimouse', pose = { y = -1 } }\n"
                     "s:check(second == world.second and third == world.third and second ~= third)\n"
                     "local other = s:load 'systems/stop_at_wall.lua'\n"
                     "s:check(second == world.second and not pcall(function() return other.second end))") == "passed");
}

TEST_CASE("connect takes ports as well as their names", "[lua][scenario][run]") {
    const std::string parts =
        "s:robot 'mouse' { model = 'raspimouse' }\n"
        "s:behavior('driver', { script = 'robot_controller', config = { speed_x = 0.1 } })\n";
    CHECK(outcome_of(parts + "s:connect(s.driver.out, s.mouse.target_velocity_in)\n"
                             "s:run(1)\ns:check(s.mouse.truth.pose.position.x > 0.05)") == "passed");
    CHECK(outcome_of(parts + "s:connect(s.driver.out, s.mouse)\ns:run(1)") ==
          "could not run: it_test.lua:4: connect: expected \"name.port\", got userdata");
    CHECK(
        outcome_of("local first = s:load 'systems/stop_at_wall.lua'\ns:load 'systems/stop_at_wall.lua'\n"
                   "s:connect(first.controller.out, first.mouse.target_velocity_in)") ==
        "could not run: it_test.lua:4: connect: controller.out is of another world than the one that was loaded last, "
        "which words add to");
}

TEST_CASE("rate and physics are taken until time moves, and refused then", "[lua][scenario][run]") {
    const std::string mouse = "s:robot 'mouse' { model = 'raspimouse' }\n";
    CHECK(outcome_of(mouse + "s:near(s.mouse.truth.pose.position.x, 0, 1) s:rate(50)\n"
                             "s:run(0.1) s:near(s.mouse.ir_sensor_out.count, 5, 1)") == "passed");
    CHECK(
        outcome_of(mouse + "s:run(0.1)\ns:rate(50)\ns:run(0.1)") ==
        "could not run: it_test.lua:4: rate: can't change once time has moved: say it before s:run and all that waits");
    CHECK(
        outcome_of(mouse + "s:run(0.1)\ns:physics { step = 0.01 }\ns:run(0.1)").find("it_test.lua:4: physics: can't") !=
        std::string::npos);
}

TEST_CASE("a robot that is to be calibrated needs its calibration wherever it is added", "[lua][scenario][run]") {
    CHECK(outcome_of("s:robot 'r' { model = 'raspimouse', calibrated = true }\ns:run(0.1)")
              .find("robot 'r': calibrated = true, and there is no ") != std::string::npos);
    CHECK(outcome_of("s:load 'systems/stop_at_wall.lua' s:run(0.1)\n"
                     "s:robot 'r' { model = 'raspimouse', pose = { y = 1 }, calibrated = true }\ns:run(0.1)")
              .find("robot 'r': calibrated = true, and there is no ") != std::string::npos);
}

TEST_CASE("the message of a check is a text", "[lua][scenario][run]") {
    CHECK(outcome_of("s:check(true, {})") ==
          "could not run: it_test.lua:2: check: expected a message (a text), got table");
    CHECK(outcome_of("s:check(1 == 2, 3.5)") == "failed: it_test.lua:2: check failed: 3.5");
    CHECK(outcome_of("s:near(1, 1, 1, {})") ==
          "could not run: it_test.lua:2: near: expected a message (a text), got table");
}

TEST_CASE("a component whose world can't be built says why", "[lua][scenario][run]") {
    CHECK(outcome_of("local mouse = s:robot 'mouse' { model = 'raspimouse' }\n"
                     "s:connect('mouse.nothing', 'mouse.target_velocity_in')\n"
                     "return mouse.truth")
              .starts_with("could not run: it_test.lua:3: "));
    CHECK(outcome_of(
              "local begun = s:robot 'mouse'\ns:load 'systems/stop_at_wall.lua'\nbegun { model = 'raspimouse' }") ==
          "could not run: it_test.lua:4: the name before this table was of a world that was loaded since");
}

TEST_CASE("a failure tells by how much, the ports it looked at and the time", "[lua][scenario][run]") {
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

TEST_CASE("a run tells how near its conditions came to their limits", "[lua][scenario][run]") {
    ScenarioRig rig(
        "scenario('it', function(s)\n"
        "  s:load 'systems/stop_at_wall.lua'\n"
        "  s:always('early', function() return s:now() < 1.25 end)\n"
        "  s:run(1)\n"
        "end)");
    CHECK(rig.run().margins ==
          std::vector<std::string>{"always 'early': came within 0.25 of the limit at 1.00 s (s:now() < 1.25)"});
}

TEST_CASE("a hold that begins at its limit tells how near it came to it afterwards", "[lua][scenario][run]") {
    const auto margins = [](const std::string& condition) {
        ScenarioRig rig(
            "scenario('it', function(s)\n  s:load 'systems/stop_at_wall.lua'\n  s:maintain('holds', { hold = 1 }, "
            "function() " +
            condition + " end)\nend)");
        return rig.run().margins;
    };
    // It grows from 0.005 on: only its end says something.
    CHECK(margins("return s:now() > 0.495") ==
          std::vector<std::string>{"maintain 'holds': came within 1.005 of the limit at 1.50 s (s:now() > 0.495)"});
    // What holds from the first sample on has not crossed its limit.
    CHECK(margins("return s:now() > -0.25") ==
          std::vector<std::string>{"maintain 'holds': came within 0.26 of the limit at 0.01 s (s:now() > -0.25)"});
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

TEST_CASE("a condition looks, and lets no time pass", "[lua][scenario][run]") {
    for (const std::string inner : {"s:run(0.1)", "s:always('b', function() return true end)"}) {
        const std::string outcome = outcome_of(
            "s:load 'systems/stop_at_wall.lua'\n"
            "s:always('a', function() " +
            inner + " return true end)\ns:run(1)");
        CHECK(outcome.starts_with("could not run: it_test.lua:3: always 'a': "));
        CHECK(outcome.ends_with(": a condition only looks: time and expectations are the scenario's"));
    }
    CHECK(outcome_of("s:load 'systems/stop_at_wall.lua'\n"
                     "s:always('a', function() s:check(s:now() < 0.05, 'late') return true end)\n"
                     "s:run(1)") == "failed: it_test.lua:3: check failed: late");
}

TEST_CASE("time passes from within coroutines, protected calls and sorting alike", "[lua][scenario][run]") {
    CHECK(outcome_of("s:load 'systems/stop_at_wall.lua'\n"
                     "local step = coroutine.wrap(function() s:run(0.5) coroutine.yield() s:run(0.5) end)\n"
                     "step() step() pcall(s.run, s, 1)\n"
                     "table.sort({ 2, 1 }, function(a, b) s:run(0.5) return a < b end)\n"
                     "s:check(s:now() >= 2.5, tostring(s:now()))") == "passed");
}
