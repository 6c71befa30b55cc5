// Methods of scenarios refuse wrong arguments. Texts with mistakes are in tests/texts/scenarios.
#include <catch2/catch.hpp>
#include <map>
#include <string>

#include "bindings/lua/files/system_lua.hpp"
#include "bindings/scenario/scenario_methods.hpp"
#include "tests/unit/scenario/scenario_rig.hpp"

using namespace nezumi;

namespace {

std::string with_world(const std::string& line) { return outcome_of("s:load 'systems/stop_at_wall.lua'\n" + line); }

}  // namespace

TEST_CASE("every method of a scenario refuses too many arguments and a wrong type", "[scenario][bridge]") {
    struct Refusals {
        std::string surplus, surplus_says, wrong, wrong_says;
    };
    const std::string f = "function() return true end";
    const std::string watch = ": expected at most 3 arguments, got 4: ";
    const std::string no_name = ": expected a name (what should hold), got boolean";
    const std::string no_port = "expected a port or \"name.port\", got boolean";
    const std::string no_component = "expected a component or its name, got boolean";
    std::map<std::string, Refusals> table{
        {"run",
         {"s:run(1, 2)", "expected at most 1 argument, got 2: run(seconds)", "s:run 'x'",
          "expected seconds from 0 on, got string"}},
        {"check",
         {"s:check(true, 'a', 3)", "expected at most 2 arguments, got 3: check(value, message)", "s:check()",
          "expected a value"}},
        {"near",
         {"s:near(1, 1, 0, 'a', 5)", "expected at most 4 arguments, got 5: near(actual, expected, tolerance, message)",
          "s:near(1, 'x', 0)", "expected the expected value (a number), got string"}},
        {"equal",
         {"s:equal(1, 1, 'a', 5)", "expected at most 3 arguments, got 4: equal(actual, expected, message)",
          "s:equal(1)", "expected two values, the actual one and the expected one"}},
        {"measure",
         {"s:measure('a', 1, 's', 2)", "expected at most 3 arguments, got 4: measure(name, value, unit)",
          "s:measure('a', 'x')", "'a': expected a number, got string"}},
        {"now", {"s:now(1)", "expected no arguments, got 1: now()", "", ""}},
        {"load",
         {"s:load('a', {}, 3)", "expected at most 2 arguments, got 3: load(file, { robots = { NAME = { ... } } })",
          "s:load(5)", "expected the name of a system file, as in s:load \"systems/stop_at_wall.lua\""}},
        {"golden",
         {"s:golden('a.csv', { tolerence = 1 }, 'mouse.ir_sensor_out')",
          "'a.csv': unknown option 'tolerence' (did you mean 'tolerance'?)", "s:golden('a.csv', true)",
          "'a.csv': " + no_port}},
        {"reload",
         {"s:reload('controller', { text = '' }, 3)",
          "expected at most 2 arguments, got 3: reload(component, { file = } or { text = })",
          "s:reload('controller', {})", "expected { file = \"NAME\" } or { text = \"...\" }"}},
        {"disturb",
         {"s:disturb('mouse', { vx = 0.1 }, 3)",
          "expected at most 2 arguments, got 3: disturb(robot, { vx =, vy =, va =, seconds = })", "s:disturb(true, {})",
          no_component}},
        {"press",
         {"s:press('mouse', 'switch0', 1, 4)", "expected at most 3 arguments, got 4: press(robot, sensor, seconds)",
          "s:press('mouse', 5)", "expected the name of a button or touch sensor"}},
        {"teleport",
         {"s:teleport('mouse', { x = 1 }, 3)", "expected at most 2 arguments, got 3: teleport(robot, pose)", "", ""}},
        {"allow_error",
         {"s:allow_error('mouse', 2)", "expected at most 1 argument, got 2: allow_error(component)",
          "s:allow_error(true)", no_component}},
        {"any",
         {"s:any('gust', {}, 3)", "expected at most 2 arguments, got 3: any(name, { at = range(0, 10), ... })",
          "s:any(true)", "expected a name, as in s:any(\"gust\", { at = range(0, 10) }), got boolean"}},
        {"recorded",
         {"s:recorded('a', 2)", "'a': options expected a table, got number", "s:recorded(true)",
          "expected the file of a recording, as in s:recorded \"drive.mcap\""}},
        {"judge",
         {"s:judge({}, 2)",
          "expected at most 1 argument, got 2: judge{ behavior =, component =, run =, map =, tolerance = }",
          "s:judge(true)", "expected options, as in s:judge { behavior = \"keeper\", run = \"drive.mcap\" }"}},
        {"restore",
         {"s:restore('mouse', 2)", "expected at most 1 argument, got 2: restore(thing)", "s:restore(true)", no_port}},
    };
    for (const std::string word : {"always", "never", "wait_until", "eventually", "maintain"}) {
        const bool watches = word == "always" || word == "never";
        table[word] = {"s:" + word + "('a', {}, " + f + ", 4)",
                       "expected at most 3 arguments, got 4: " + word +
                           (watches ? "(name, function)" : "(name, options, function)"),
                       "s:" + word + "(true, " + f + ")", "expected a name (what should hold), got boolean"};
    }
    for (const std::string word : {"drop", "freeze"}) {
        table[word] = {"s:" + word + "('mouse.ir_sensor_out', 1, 3)",
                       "expected at most 2 arguments, got 3: " + word + "(port, seconds)", "s:" + word + "(true)",
                       no_port};
    }
    table["inject"] = {"s:inject('mouse.ir_sensor_out', {}, 3)",
                       "expected at most 2 arguments, got 3: inject(port, value)", "s:inject(true)", no_port};
    table["hold"] = {"s:hold('mouse.ir_sensor_out', {}, {}, 4)",
                     "expected at most 3 arguments, got 4: hold(port, value, { take = true })", "s:hold(true)",
                     no_port};
    table["release"] = {"s:release('mouse.ir_sensor_out', 2)", "expected at most 1 argument, got 2: release(port)",
                        "s:release(true)", no_port};
    for (const auto* methods : {&ScenarioRun::Methods::of_time(), &ScenarioRun::Methods::of_acts()}) {
        for (const auto& method : *methods) {
            CAPTURE(method.name);
            CHECK((table.contains(method.name) || std::string(method.usage) == "()"));
        }
    }
    for (const auto& [word, refusals] : table) {
        const std::string begin = "could not run: it_test.lua:3: " + word + ": ";
        CHECK(with_world(refusals.surplus) == begin + refusals.surplus_says);
        if (!refusals.wrong.empty()) CHECK(with_world(refusals.wrong) == begin + refusals.wrong_says);
    }
}
