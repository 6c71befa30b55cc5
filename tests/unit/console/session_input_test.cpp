// What is typed: expressions, statements, names, mistakes, loops without end.
#include <catch2/catch.hpp>

#include "bindings/console/input_text.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"
#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("an expression shows its value, a statement nothing", "[console][session]") {
    SessionRig it;
    CHECK(it.type("1 + 2") == "3");
    CHECK(it.type("'a', nil, 2.5") == "\"a\"\tnil\t2.5");
    CHECK(it.type("{ 1, x = { 2 } }") == "{ 1, x = { 2 } }");
    CHECK(it.type("x = 5").empty());
    CHECK(it.type("x * 2") == "10");
    CHECK(it.type("return x") == "5");
    CHECK(it.type("local y = 1 print(y, 'text', { 1 })") == "1\ttext\t{ 1 }");
    CHECK(it.type("").empty());
    CHECK(it.type("-- nothing").empty());
    CHECK(it.type("function twice(n) return 2 * n end").empty());
    CHECK(it.type("twice(4)") == "8");
    CHECK(it.finished == 11);
}

TEST_CASE("a keyword after a dot becomes a name, in code alone", "[console][input]") {
    CHECK(with_keyword_names("controller.in") == "controller[\"in\"]");
    CHECK(with_keyword_names(".in") == ".in");
    CHECK(with_keyword_names("a.ports.end.value[1]") == "a.ports[\"end\"].value[1]");
    CHECK(with_keyword_names("'controller.in' .. \"b.in\" -- c.in\n--[[ d.in ]] [[e.in]]") ==
          "'controller.in' .. \"b.in\" -- c.in\n--[[ d.in ]] [[e.in]]");
    CHECK(with_keyword_names("for i = 1, n do x = 1. end") == "for i = 1, n do x = 1. end");
    CHECK(with_keyword_names("a . \n in") == "a [\"in\"] \n ");
    CHECK(with_keyword_names("x = a ..in") == "x = a ..in");
}

TEST_CASE("an input that lacks its end waits for more lines", "[console][input]") {
    for (const char* text :
         {"for i = 1, 3 do", "f(", "f(1", "x = {", "[[long", "if controller.in then", "function f()", "1 +"}) {
        INFO(text);
        CHECK_FALSE(Session::is_complete(text));
    }
    for (const char* text :
         {"1", "x = 1", "for i = 1, 3 do print(i) end", "controller.in", "", "1 1", "'open", "end"}) {
        INFO(text);
        CHECK(Session::is_complete(text));
    }
}

TEST_CASE("an error costs a line and no more", "[console][session]") {
    SessionRig it;
    CHECK(it.type("contoller.status") == "! unknown name 'contoller' (did you mean 'controller'?)");
    CHECK(it.type("speed_x") == "! unknown name 'speed_x' (did you mean 'controller.config.speed_x'?)");
    CHECK(it.type("pasue()") == "! unknown name 'pasue' (did you mean 'pause'?)");
    CHECK(it.type("controller.config.speed_x = 9") == "! parameter 'speed_x' (number): 9.0 is above its maximum 1.5");
    CHECK(it.type("x = = 1") == "! unexpected symbol near '='");
    CHECK(it.type("x = 1\nerror('no')\n") == "! line 2: no");
    CHECK(it.type("error(nil)") == "! an error of value nil");
    CHECK(it.type("mouse = 1") == "! 'mouse' is a component: choose another name");
    CHECK(it.type("ls = 1") == "! 'ls' is a word of the console: choose another name");
    CHECK(it.type("math.sin = 1") == "! can't set 'math.sin': 'math' is read-only");
    CHECK_FALSE(it.all_well);
    CHECK(it.type("1") == "1");
    CHECK(it.all_well);
    CHECK_THAT(it.type("controller:fail()"), Contains("counter.lua:10: no luck"));
    CHECK_THAT(it.type(std::string(70'000, ' ')), Contains("the input is too long"));
}

TEST_CASE("an endless loop ends with a message", "[console][session][wallclock][watchdog]") {
    SessionRig it;
    CHECK(it.type("while true do end") == "! ran for more than 5 s: is there an endless loop?");
    CHECK(it.type("1") == "1");
}

TEST_CASE("what is done for an input between ticks counts as its own time", "[console][session][wallclock][watchdog]") {
    // Most of such a loop's time is the script's, which the thread that ticks runs.
    SessionRig it(counter_system, {{"counter", counter_behavior + R"(
command("work", function() for i = 1, 3e5 do end end)
)"}});
    const std::int64_t began = thread_time();
    CHECK(it.type("while true do controller:work() end") == "! ran for more than 5 s: is there an endless loop?");
    CHECK(static_cast<double>(thread_time() - began) < 7.5e9);
}

TEST_CASE("an input can be interrupted", "[console][session][watchdog]") {
    SessionRig it;
    it.session->submit("while true do end");
    it.session->submit("1");
    it.session->advance();
    CHECK(it.session->is_busy());
    it.session->interrupt();
    CHECK_FALSE(it.session->is_busy());
    CHECK(it.shown == "! interrupted");
    CHECK(it.finished == 2);
    CHECK(it.type("2") == "2");
}

TEST_CASE("what was said before an interrupt is shown, and nothing that comes after it",
          "[console][session][watchdog]") {
    SessionRig it;
    it.session->submit("print 'before' while true do pcall(function() print(controller.status) end) end");
    while (it.shown.find("ACTIVE") == std::string::npos) it.session->advance();
    it.session->interrupt();
    CHECK_THAT(it.shown, StartsWith("before\nACTIVE\n") && Catch::Matchers::EndsWith("\n! interrupted"));
    it.shown.clear();
    CHECK(it.type("controller.status") == "\"ACTIVE\"");
}

TEST_CASE("a question is answered with nothing when it is interrupted", "[console][completion][watchdog]") {
    SessionRig it;
    it.session->submit("while true do end");
    int answers = 0;
    it.session->complete("contr", 5, [&](const Completion& found) { answers += found.candidates.empty() ? 1 : 100; });
    it.session->advance();
    it.session->interrupt();
    CHECK(answers == 1);
    CHECK_FALSE(it.session->is_busy());
    CHECK(it.complete("contr").candidates == std::vector<std::string>{"controller"});
}
