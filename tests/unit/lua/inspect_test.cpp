// How values are shown: every limit to the letter.
#include <catch2/catch.hpp>

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

TEST_CASE("a table takes one line while that is no wider than it may be", "[lua][inspect]") {
    CHECK(text_of("{ 1, 2 }", {.width = 8}) == "{ 1, 2 }");
    CHECK(text_of("{ 1, 2 }", {.width = 7}) == "{\n  1,\n  2\n}");
    CHECK(text_of("{ a = { 1, 2 }, b = 3 }", {.width = 14}) == "{\n  a = { 1, 2 },\n  b = 3\n}");
    CHECK(text_of("{ a = { 1, 2 }, b = 3 }", {.width = 13}) == "{\n  a = {\n    1,\n    2\n  },\n  b = 3\n}");
    CHECK(text_of("{}", {.width = 2}) == "{}");
    CHECK(text_of("{}", {.width = 1}) == "{}");  // there is nothing to put into several lines
}

TEST_CASE("texts, entries and depth are cut where they may be no longer", "[lua][inspect]") {
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

TEST_CASE("what several values may take together is shared", "[lua][inspect]") {
    InspectWork work{.steps = 4, .bytes = 1000};
    CHECK(text_of("{ 1, 2, 3 }", {.work = &work}) == "{ 1, 2, 3 }");
    CHECK(work.steps == 1);
    CHECK(work.bytes == 1000 - 11);
    CHECK(text_of("{ 1, 2, 3 }", {.work = &work}) == "{ 1, 2, 3, ... }");
    CHECK(work.steps == 0);
    CHECK(text_of("{ 1 }", {.work = &work}) == "{...}");
}
