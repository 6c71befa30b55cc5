// Slips in a scenario's own words: the scenario could not be run, and what is in the text is found before it runs.
#include <catch2/catch.hpp>
#include <map>
#include <string>

#include "bindings/lua/files/system_lua.hpp"
#include "bindings/scenario/method_scan.hpp"
#include "bindings/scenario/scenario_methods.hpp"
#include "tests/unit/scenario/scenario_rig.hpp"

using namespace nezumi;

namespace {

std::string slips(const std::string& text) {
    const std::vector<std::string_view> words{"always", "check", "run"};
    std::string all;
    for (const Error& error : unknown_methods(text, "t.lua", words)) all += describe(error) + "\n";
    return all;
}

std::string with_world(const std::string& line) { return outcome_of("s:load 'systems/stop_at_wall.lua'\n" + line); }

}  // namespace

TEST_CASE("every method of a scenario refuses an argument too many and one of a wrong kind", "[scenario][bridge]") {
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

TEST_CASE("words that a scenario does not have are found in its text", "[scenario][diagnostics]") {
    CHECK(slips("scenario('a', function(s)\n  s:rum(1) s:run(1)\n  if x then s:chek(1) end\nend)") ==
          "t.lua:2:5: s has no 'rum' (did you mean 'run'?)\nt.lua:3:15: s has no 'chek' (did you mean 'check'?)\n");
    CHECK(slips("scenario('a', { sweep = { f = { function() end } } }, function(it, p) it:rum() end)") ==
          "t.lua:1:74: it has no 'rum' (did you mean 'run'?)\n");
    CHECK(slips("scenario('a', function(s) local function g() s:rum() end for i = 1, 2 do g() end end) s:rum()") ==
          "t.lua:1:48: s has no 'rum' (did you mean 'run'?)\n");
    CHECK(slips("scenario('a', function(s) s:run() end) scenario('b', function(t) t:rum() end)") ==
          "t.lua:1:68: t has no 'rum' (did you mean 'run'?)\n");
    CHECK(slips("scenario('a', function(s) repeat local x = 1 until x s:rum() end)") ==
          "t.lua:1:56: s has no 'rum' (did you mean 'run'?)\n");
}

TEST_CASE("a scenario is followed past locals without a value", "[scenario][diagnostics]") {
    CHECK(slips("scenario('a', function(s) local a\ns:rum() end)") ==
          "t.lua:2:3: s has no 'rum' (did you mean 'run'?)\n");
    CHECK(slips("scenario('a', function(s) local a <const>, b; s:rum() end)") ==
          "t.lua:1:49: s has no 'rum' (did you mean 'run'?)\n");
    CHECK(slips("scenario('a', function(s) do local s = 1 s:rum() end s:chek() end)") ==
          "t.lua:1:56: s has no 'chek' (did you mean 'check'?)\n");
    CHECK(slips("scenario('a', function(s) if x then local s = 1 s:rum() else s:chek() end end)") ==
          "t.lua:1:64: s has no 'chek' (did you mean 'check'?)\n");
    CHECK(slips("scenario('a', function(s) f(function(s) s:rum() end) local function s() end s:rum() end)").empty());
    CHECK(slips("scenario('a', function(s) for s in x do s:rum() end s:chek() end)") ==
          "t.lua:1:55: s has no 'chek' (did you mean 'check'?)\n");
}

TEST_CASE("a scenario is followed into functions that have a name", "[scenario][diagnostics]") {
    const std::string says = "t has no 'rum' (did you mean 'run'?)\n";
    CHECK(slips("local function body(t) t:rum() end scenario('a', {}, body) scenario('b', body)") ==
          "t.lua:1:26: " + says);
    CHECK(slips("local body = function(t) t:rum() end scenario('a', body)") == "t.lua:1:28: " + says);
    CHECK(slips("local function f(x, t) t:rum() end scenario('a', function(s) f({ 1, s }, s) f(s.mouse, 2) end)") ==
          "t.lua:1:26: " + says);
    CHECK(slips("local function g(t) t:rum() end local function f(it) g(it) end scenario('a', function(s) f(s) end)") ==
          "t.lua:1:23: " + says);
    CHECK(slips("function f(t) f(t) t:rum() end scenario('a', f)") == "t.lua:1:22: " + says);
    // Not given the scenario, or nobody knows.
    CHECK(slips("local function f(t) t:rum() end scenario('a', function(s) f(s.mouse) f(x, s) x.f(s) end)").empty());
    CHECK(slips("local function f(t) t:rum() end function f(t) end scenario('a', function(s) f(s) end)").empty());
    CHECK(slips("local function f(t) t:rum() end scenario('a', f())").empty());
    CHECK(slips("local function f() s:rum() end scenario('a', f)").empty());
}

TEST_CASE("a scenario is followed under a further name", "[scenario][diagnostics]") {
    CHECK(slips("scenario('a', function(s) local w = s w:rum() do local v <const> = w; v:chek() end v:rum() end)") ==
          "t.lua:1:41: w has no 'rum' (did you mean 'run'?)\n"
          "t.lua:1:73: v has no 'chek' (did you mean 'check'?)\n");
    CHECK(slips("scenario('a', function(s) local s = s s:rum() end)") ==
          "t.lua:1:41: s has no 'rum' (did you mean 'run'?)\n");
    CHECK(slips("scenario('a', function(s) local w = s.mouse w:rum() local v = s or w v:rum() end)").empty());
    CHECK(slips("scenario('a', function(s) s = other s:rum() end)").empty());
    CHECK(slips("scenario('a', function(s) f { s = s } s:rum() end)") ==
          "t.lua:1:41: s has no 'rum' (did you mean 'run'?)\n");
}

TEST_CASE("a seed that is called as a method is refused with what gives a scenario one", "[scenario][diagnostics]") {
    const std::string says =
        "s has no 'seed': the option seed = N of the scenario gives its runs one, and s.seed reads it";
    CHECK(slips("scenario('a', function(s) s:seed(3) end)") == "t.lua:1:29: " + says + "\n");
}

TEST_CASE("what only looks like a scenario's word is left alone", "[scenario][diagnostics]") {
    CHECK(slips("-- s:rum()\nscenario('a', function(s) print('s:rum()') x.s:rum() y:s() s.rum() s.mouse:rum() end)")
              .empty());
    CHECK(slips("scenario('a', function(s) local s = other s:rum() end)").empty());
    CHECK(slips("scenario('a', function(s) local a, s = 1, 2 s:rum() end)").empty());
    CHECK(slips("scenario('a', function(s) f(function(s) s:rum() end) end)").empty());
    CHECK(slips("scenario('a', function(s) for _, s in pairs(t) do s:rum() end end)").empty());
    CHECK(slips("scenario('a', function(s)").empty());
    CHECK(slips("scenario(").empty());
    CHECK(slips("scenario 'a'").empty());
}

TEST_CASE("a scenario's function declares what it is given", "[scenario][diagnostics]") {
    ScenarioRig rig("scenario('it', function(s, p, extra) end)");
    static_cast<void>(rig.session());
    CHECK(rig.said.find("scenario 'it': the function gets the scenario and its values; its parameter 'extra' is never "
                        "given: leave it out") != std::string::npos);
}
