// An argument too many or of the wrong kind is an error, for every word of scripts and of system files.
#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <string>

#include "bindings/lua/files/system_lua.hpp"
#include "bindings/lua/script/script_globals.hpp"
#include "tests/unit/lua/rig.hpp"
#include "tests/unit/lua/system_reader.hpp"

using namespace nezumi;

namespace {

// What is wrong with two calls of a word.
struct Refusals {
    std::string surplus, surplus_says;
    std::string wrong, wrong_says;
};

template <class Words>
void check_covered(const std::map<std::string, Refusals>& table, const Words& words,
                   const std::set<std::string>& not_called) {
    for (const auto& word : words) {
        CAPTURE(word);
        CHECK((table.contains(std::string(word)) || not_called.contains(std::string(word))));
    }
}

}  // namespace

TEST_CASE("every word of a script refuses too many arguments and a wrong type", "[lua][bridge]") {
    const std::map<std::string, Refusals> table{
        {"input",
         {"input('a', 'TimedLong', 'doc', {}, 5)",
          "input: expected at most 4 arguments, got 5: input(name, type, doc, options)", "input('a', 'TimedLong', 5)",
          "input 'a': its description expected a string, got number"}},
        {"output",
         {"output('a', 'TimedLong', 'doc', {}, 5)",
          "output: expected at most 4 arguments, got 5: output(name, type, doc, options)", "output(5, 'TimedLong')",
          "output: its name expected a string, got number"}},
        {"param",
         {"param('a', 1, {}, 4)", "param: expected at most 3 arguments, got 4: param(name, default, options)",
          "param('a', print)",
          "parameter 'a': its default expected a boolean, a number, a string or an array of them, got function"}},
        {"command",
         {"command('a', print, 'doc', 4)", "command: expected at most 3 arguments, got 4: command(name, function, doc)",
          "command('a', 5)", "command 'a': expected a function, got number"}},
        {"about",
         {"about({}, 2)", "about: expected at most 1 argument, got 2: about { version =, vendor =, category = }",
          "about 'me'", "about expected a table, got string"}},
        {"require",
         {"require('a', 2)", "require: expected at most 1 argument, got 2: require(name)", "require(5)",
          "require expected a module's name, got number"}},
        {"task",
         {"task('a', print, {}, 4)", "task: expected at most 3 arguments, got 4: task(name, function, options)",
          "task('a', 5)", "task 'a': expected a function, got number"}},
        {"start",
         {"start('a', 2)", "start: expected at most 1 argument, got 2: start(name)", "start(5)",
          "start expected a task's name, got number"}},
        {"cancel",
         {"cancel('a', 2)", "cancel: expected at most 1 argument, got 2: cancel(name)", "cancel(5)",
          "cancel expected a task's name, got number"}},
        {"wait",
         {"wait(1, 2)", "wait: expected at most 1 argument, got 2: wait(seconds)", "wait 'a'",
          "wait expected seconds, got string"}},
        {"wait_until",
         {"wait_until(print, {}, 3)", "wait_until: expected at most 2 arguments, got 3: wait_until(condition, options)",
          "wait_until(5)", "wait_until expected a function, got number"}},
        {"probe",
         {"probe('a', 1, 2)", "probe: expected at most 2 arguments, got 3: probe(name, value)", "probe(5, 1)",
          "probe expected a name, got number"}},
        {"constants",
         {"constants('a', 'b')", "constants: expected at most 1 argument, got 2: constants(type)", "constants(5)",
          "constants: expected a type's name, got number"}},
        {"now", {"now(1)", "now: expected no arguments, got 1: now()", "", ""}},
    };
    check_covered(table, script_globals(), {"config", "dt", "log", "state"});
    for (const auto& [word, refusals] : table) {
        CHECK(refusal(refusals.surplus) == "robot_controller.lua:1: " + refusals.surplus_says);
        if (!refusals.wrong.empty()) CHECK(refusal(refusals.wrong) == "robot_controller.lua:1: " + refusals.wrong_says);
    }
    CHECK(failure_of("local a = input('a', 'TimedLong')", "a:read(1)") ==
          "robot_controller.lua:3: input 'a':read: expected no arguments, got 1: input 'a':read()");
    CHECK(failure_of("local a = output('a', 'TimedLong')", "a:write(1, 2)") ==
          "robot_controller.lua:3: output 'a':write: expected at most 1 argument, got 2: output 'a':write(value)");
    CHECK(failure_of("local a = output('a', 'TimedLong')", "a:write 'x'") ==
          "robot_controller.lua:3: output 'a' (TimedLong): expected an integer, got string");
}

TEST_CASE("a callback with an unused parameter is refused", "[lua][bridge]") {
    CHECK(refusal("function on_execute(dt) end") ==
          "robot_controller.lua:1: on_execute: its parameter 'dt' is never given: `dt` is a global");
    CHECK(refusal("param('x', 1)\n\non_activated = function(time) end") ==
          "robot_controller.lua:3: on_activated: its parameter 'time' is never given: `now()` is the time");
    CHECK(refusal("function on_error(self, message) end") ==
          "robot_controller.lua:1: on_error: its parameter 'self' is never given: leave it out");
    CHECK(refusal("function on_reload(old, new) end") ==
          "robot_controller.lua:1: on_reload: its parameter 'new' is never given: leave it out");
    CHECK(refusal("function on_reload(old_version) end function on_execute() end") == "");
    CHECK(refusal("on_execute = print") == "");
    CHECK(refusal("command('go', function(a, b) end)") == "");
}

TEST_CASE("every word of a system file refuses too many arguments and a wrong type", "[lua][bridge]") {
    const std::string entry = ": expected at most 2 arguments, got 3: ";
    const std::string fields = ": expected at most 1 argument, got 2: ";
    std::map<std::string, Refusals> table{
        {"argument",
         {"argument('a', 1, {}, 4)",
          "argument: expected at most 3 arguments, got 4: argument(name, default, { min =, max =, doc = })",
          "argument(5, 1)", "argument: expected a name and a default, as in argument(\"n\", 5), got number"}},
        {"connect",
         {"connect('a.b', 'c.d', 3)", "connect" + entry + "connect(from, to)", "connect('a.b', 5)",
          "connect: expected \"name.port\", got number"}},
        {"csv",
         {"csv('a.csv', 2)", "csv" + fields + "csv \"FILE\"", "csv(5)", "csv: expected a file's name, got number"}},
        {"map",
         {"map('a.yaml', 2)", "map" + fields + "map \"FILE\"", "map(5)", "map: expected a file's name, got number"}},
        {"maze",
         {"maze('a.txt', 2)", "maze" + fields + "maze \"FILE\" or { ... }", "maze(5)",
          "maze: expected a table, got number"}},
        {"rate",
         {"rate(100, 2)", "rate" + fields + "rate(hertz)", "rate 'x'",
          "rate: expected a positive number of ticks per second, got string"}},
        {"seed",
         {"seed(1, 2)", "seed" + fields + "seed(number)", "seed 'x'",
          "seed: expected a whole number from 0 on, got string"}},
    };
    for (const std::string word : {"robot", "behavior", "component"}) {
        table[word] = {word + "('a', {}, 3)", word + entry + word + " \"NAME\" { ... }", word + "(5)",
                       word + ": expected a name, got number: write " + word + " \"NAME\" { ... }"};
    }
    for (const std::string word :
         {"arena", "box", "cylinder", "floor", "line", "marker", "network", "physics", "ros", "rtm", "wall"})
        table[word] = {word + "({}, 2)", word + fields + word + " { ... }", word + " 'x'",
                       word + ": expected a table, got string"};
    check_covered(table, system_word_names(peer_words()), {});
    for (const auto& [word, refusals] : table) {
        CHECK(system_files::system_error(refusals.surplus) == "s.lua:1: " + refusals.surplus_says);
        CHECK(system_files::system_error(refusals.wrong) == "s.lua:1: " + refusals.wrong_says);
    }
    CHECK(system_files::system_error("robot 'm' ({ model = 'raspimouse' }, 2)") ==
          "s.lua:1: robot 'm': expected at most 1 argument, got 2: robot 'm' { ... }");
    CHECK(system_files::system_error("require('a', 2)") ==
          "s.lua:1: require: expected at most 1 argument, got 2: require(name)");
}
