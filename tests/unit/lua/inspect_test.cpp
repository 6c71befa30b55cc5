// How values are shown: every limit to the letter.
#include <algorithm>
#include <catch2/catch.hpp>
#include <ctime>

#include "bindings/lua/sandbox/inspect.hpp"
#include "sandbox_support.hpp"

using namespace nezumi;

namespace {

std::string text_of(const std::string& expression, const InspectOptions& options = {}) {
    Box box;
    lua_settop(box.lua(), 0);
    REQUIRE(load_chunk(box.lua(), compile("return " + expression, "box.lua").value()));
    REQUIRE(protected_call(box.lua(), 0, 1, Budget{10.0}));
    return inspect(box.lua(), 1, options);
}

}  // namespace

TEST_CASE("a table is shown in one line if it fits", "[lua][inspect]") {
    CHECK(text_of("{ 1, 2 }", {.width = 8}) == "{ 1, 2 }");
    CHECK(text_of("{ 1, 2 }", {.width = 7}) == "{\n  1,\n  2\n}");
    CHECK(text_of("{ a = { 1, 2 }, b = 3 }", {.width = 14}) == "{\n  a = { 1, 2 },\n  b = 3\n}");
    CHECK(text_of("{ a = { 1, 2 }, b = 3 }", {.width = 13}) == "{\n  a = {\n    1,\n    2\n  },\n  b = 3\n}");
    CHECK(text_of("{}", {.width = 2}) == "{}");
    CHECK(text_of("{}", {.width = 1}) == "{}");  // there is nothing to put into several lines
}

TEST_CASE("long texts, many entries and deep tables are cut", "[lua][inspect]") {
    CHECK(text_of("'abcd'", {.text = 4}) == "\"abcd\"");
    CHECK(text_of("'abcd'", {.text = 3}) == "\"abc\"...");
    CHECK(text_of("'abcd'", {.text = 3, .quote = false}) == "abc...");
    CHECK(text_of("{ 1, 2, 3 }", {.items = 3}) == "{ 1, 2, 3 }");
    CHECK(text_of("{ 1, 2, 3 }", {.items = 2}) == "{ 1, 2, ... }");
    CHECK(text_of("{ { {} } }", {.depth = 3}) == "{ { {} } }");
    CHECK(text_of("{ { {} } }", {.depth = 2}) == "{ { {...} } }");
    CHECK(text_of("(function() local t = {} t.t = t return t end)()") == "{ t = <cycle> }");
    CHECK(text_of("(function() local t = {} return { t, t } end)()") == "{ {}, {} }");
}

TEST_CASE("several values share one limit", "[lua][inspect]") {
    InspectWork work{.steps = 4, .bytes = 1000};
    CHECK(text_of("{ 1, 2, 3 }", {.work = &work}) == "{ 1, 2, 3 }");
    CHECK(work.steps == 1);
    CHECK(work.bytes == 1000 - 11);
    CHECK(text_of("{ 1, 2, 3 }", {.work = &work}) == "{ 1, 2, 3, ... }");
    CHECK(work.steps == 0);
    CHECK(text_of("{ 1 }", {.work = &work}) == "{...}");
}

TEST_CASE("values are shown in Lua syntax, in several lines if one is too long", "[lua][inspect]") {
    Box box;
    const auto shown = [&](const std::string& text, const InspectOptions& options = {}) {
        box.run("return 1");
        const auto chunk = compile("return " + text, "box.lua");
        REQUIRE(load_chunk(box.lua(), *chunk).has_value());
        REQUIRE(protected_call(box.lua(), 0, 1, Budget{1.0}).has_value());
        std::string result = inspect(box.lua(), -1, options);
        lua_settop(box.lua(), 0);
        return result;
    };
    CHECK(shown("nil") == "nil");
    CHECK(shown("'a\"b'") == "\"a\\\"b\"");
    CHECK(shown("'a'", {.quote = false}) == "a");
    CHECK(shown("{}") == "{}");
    CHECK(shown("{ 1, 2.5, 'x', b = true, a = { c = {} }, [7] = 1, ['in'] = 2 }") ==
          "{ 1, 2.5, \"x\", [7] = 1, a = { c = {} }, b = true, [\"in\"] = 2 }");
    CHECK(shown("{ aaaa = { 1, 2, 3 }, bbbb = { 4, 5 } }", {.width = 30}) ==
          "{\n  aaaa = { 1, 2, 3 },\n  bbbb = { 4, 5 }\n}");
    CHECK(shown("(function() local t = { 1 } t[2] = t return t end)()") == "{ 1, <cycle> }");
    CHECK(shown("{ { { 1 } } }", {.depth = 2}) == "{ { {...} } }");
    CHECK(shown("{ 1, 2, 3 }", {.items = 2}) == "{ 1, 2, ... }");
    CHECK(shown("setmetatable({}, { __tostring = function() return 'me' end })") == "me");
    CHECK(shown("setmetatable({}, { __tostring = function() error('x', 0) end })") == "<can't be shown: box.lua:1: x>");
    CHECK(shown("{ [{}] = 1 }").find("<can't be shown: a table with a table or function as a key") == 0);
    CHECK(shown("math").find("{") == 0);
}

TEST_CASE("a large value is shown in a short time", "[lua][inspect][wallclock][watchdog]") {
    Box box;
    const auto shown = [&](const std::string& text, double& seconds) {
        box.run("return 1");
        const auto chunk = compile(
            "local function many(n, f) local t = {} for i = 1, n do t[i] = f(i) end return t end\n"
            "local function named(n) local t = {} for i = 1, n do t['key' .. i] = i end return t end\n"
            "return " +
                text,
            "box.lua");
        REQUIRE(load_chunk(box.lua(), *chunk).has_value());
        REQUIRE(protected_call(box.lua(), 0, 1, Budget{20.0}).has_value());
        std::string result;
        seconds = 1;
        for (int attempt = 0; attempt < 3; ++attempt) {  // a busy machine takes time at random: the best is its own
            const auto before = std::clock();
            result = inspect(box.lua(), -1);
            seconds = std::min(seconds, static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
        }
        lua_settop(box.lua(), 0);
        lua_gc(box.lua(), LUA_GCCOLLECT);
        return result;
    };
    for (const char* huge :
         {"many(300000, function(i) return i end)", "named(200000)",
          "(function() local t = named(1900) return many(100, function() return t end) end)()",
          "many(100, function() return named(2000) end)",
          "many(100, function() return many(100, function() return many(100, tostring) end) end)",
          "many(100, function(i) return ('x'):rep(100000) end)",
          "setmetatable({}, { __tostring = function() while true do end end })",
          "setmetatable({}, { __pairs = function() return function(_, i) return (i or 0) + 1, i end end })"}) {
        double seconds = 0;
        const std::string text = shown(huge, seconds);
        INFO(huge << " took " << seconds << " s");
        CHECK(seconds < 0.05);  // 100 ms and more before; a few on a machine that has nothing else to do
        CHECK(text.size() < 200'000);
    }
    double seconds = 0;
    CHECK(shown("many(300000, function(i) return i end)", seconds).ends_with("\n  99,\n  100,\n  ...\n}"));
    CHECK(shown("named(200000)", seconds) == "{ ... }");
    CHECK(shown("{ named(1900) }", seconds).starts_with("{\n  {\n    key1 = 1,\n    key10 = 10,\n"));
    CHECK(shown("setmetatable({}, { __tostring = function() while true do end end })", seconds)
              .starts_with("<can't be shown: box.lua:3: ran for more than 0.01 s"));
}
