// What is typed: expressions, statements, names, mistakes, loops without end.
#include <catch2/catch.hpp>

#include "bindings/console/input_text.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"
#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;
using Catch::Matchers::StartsWith;

TEST_CASE("a keyword after a dot becomes a name, but not in strings and comments", "[console][input]") {
    CHECK(with_keyword_names("controller.in") == "controller[\"in\"]");
    CHECK(with_keyword_names(".in") == ".in");
    CHECK(with_keyword_names("a.ports.end.value[1]") == "a.ports[\"end\"].value[1]");
    CHECK(with_keyword_names("'controller.in' .. \"b.in\" -- c.in\n--[[ d.in ]] [[e.in]]") ==
          "'controller.in' .. \"b.in\" -- c.in\n--[[ d.in ]] [[e.in]]");
    CHECK(with_keyword_names("for i = 1, n do x = 1. end") == "for i = 1, n do x = 1. end");
    CHECK(with_keyword_names("a . \n in") == "a [\"in\"] \n ");
    CHECK(with_keyword_names("x = a ..in") == "x = a ..in");
}

TEST_CASE("an incomplete input waits for more lines", "[console][input]") {
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

TEST_CASE("an input of more than 64 KB is refused", "[console][session]") {
    SessionRig it;
    CHECK(it.type(std::string(65'537, ' ')) == "! the input is too long: at most 64 KB");
}

TEST_CASE("an endless loop ends with a message", "[console][session][wallclock][watchdog]") {
    SessionRig it;
    CHECK(it.type("while true do end") == "! ran for more than 5 s: is there an endless loop?");
    CHECK(it.type("1") == "1");
}

TEST_CASE("work between ticks counts as time of the input", "[console][session][wallclock][watchdog]") {
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

TEST_CASE("output before an interrupt is shown, later output is not", "[console][session][watchdog]") {
    SessionRig it;
    it.session->submit("print 'before' while true do pcall(function() print(controller.status) end) end");
    while (it.shown.find("ACTIVE") == std::string::npos) it.session->advance();
    it.session->interrupt();
    CHECK_THAT(it.shown, StartsWith("before\nACTIVE\n") && Catch::Matchers::EndsWith("\n! interrupted"));
    it.shown.clear();
    CHECK(it.type("controller.status") == "\"ACTIVE\"");
}

TEST_CASE("an interrupted completion has no candidates", "[console][completion][watchdog]") {
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
