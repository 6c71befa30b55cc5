// How a condition's text is changed to record what it compares. tests/texts/margins has the margins themselves.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "bindings/lua/sandbox/compile.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/scenario/condition.hpp"
#include "bindings/scenario/condition_source.hpp"

using namespace nezumi;

namespace {

ObservedSource observe(const std::string& text, FunctionPlace place = {.first_line = 1, .last_line = 1}) {
    return observe_function(SyntaxTree(text), place, "h");
}

std::string observed_text(const std::string& expression) {
    return observe("local f = function() return " + expression + " end").text;
}

// A state with a condition: the text's result.
struct Tried {
    std::unique_ptr<LuaState> state = create_sandbox().value();
    std::string text;
    FunctionTexts texts{[this](const std::string&) { return &text; }};
    std::unique_ptr<Condition> condition;

    explicit Tried(std::string source) : text(std::move(source)) {
        lua_State* lua = state->lua();
        const auto chunk = compile(text, "test.lua");
        REQUIRE(chunk);
        REQUIRE(load_chunk(lua, *chunk));
        REQUIRE(protected_call(lua, 0, 1, {}));
        auto taken = Condition::take(lua, -1, texts);
        REQUIRE(taken);
        condition = std::move(*taken);
    }
    bool sample() {
        const auto held = condition->sample(state->lua());
        REQUIRE(held);
        return *held;
    }
};

}  // namespace

TEST_CASE("a comparison is found with the texts of its sides", "[lua][scenario][condition]") {
    const ObservedSource found = observe("local f = function() return math.abs(a.velocity.vx) < limit end");
    CHECK(found.text == "function() return h(0,math.abs(a.velocity.vx) ,( limit)) end");
    REQUIRE(found.observed.comparisons.size() == 1);
    CHECK(found.observed.comparisons[0].left == "math.abs(a.velocity.vx)");
    CHECK(found.observed.comparisons[0].right == "limit");
    CHECK(found.observed.comparisons[0].unit == "m/s");
}

TEST_CASE("a number of a local's or upvalue's field is asked for by its path", "[lua][scenario][condition]") {
    const ObservedSource found =
        observe("local a = b local f = function() return math.abs(a.velocity.vx) < a.most end");
    CHECK(found.text == "function() return h(0,math.abs((h(5,a)or a.velocity.vx)) ,( (h(11,a)or a.most))) end");
    CHECK(found.observed.paths == std::vector<std::string>{"velocity.vx", "most"});
    const auto text = [](const std::string& expression) {
        return observe("local a = b local f = function() return " + expression + " end").text;
    };
    CHECK(text("a.b.c(1) < 2") == "function() return h(0,a.b.c(1) ,( 2)) end");
    CHECK(text("a.b:c() < 2") == "function() return h(0,a.b:c() ,( 2)) end");
    CHECK(text("f(a.b.c).d < a[1].b") == "function() return h(0,f((h(5,a)or a.b.c)).d ,( a[1].b)) end");
    CHECK(text("a.b == false") == "function() return h(0,(h(5,a)or a.b) ,( false)) end");
}

TEST_CASE("values and calls among comparisons are observed too", "[lua][scenario][condition]") {
    CHECK(observed_text("flag and not(a < 1)") == "function() return h(1,flag) and not(h(6,a ,( 1))) end");
    CHECK(observed_text("f(a < 1)") == "function() return h(1,h(3,f)(a < 1)) end");
    CHECK(observed_text("a < 1 == true") == "function() return h(1,a < 1 == true) end");
    CHECK(observed_text("a or-1") == "function() return h(1,a) or h(7,-1) end");
    CHECK(observed_text("not a.collided") == "function() return not h(2,a) end");
    CHECK(observed_text("f().collided") == "function() return h(2,f()) end");
    CHECK(observed_text("true or a < 1") == "function() return true or h(0,a ,( 1)) end");
}

TEST_CASE("the returns and early decisions of a function are observed", "[lua][scenario][condition]") {
    CHECK(observe("function f(x) if x > 1 then return true end return x end",
                  {.first_line = 1, .last_line = 1, .parameters = 1})
              .text == "function(x) if h(4,h(0,x ,( 1))) then return h(10,true) end return h(16,h(7,x)) end");
    // Only an `if` that contains a return decides.
    CHECK(observe("f = function() local x = 1 if x > 1 then x = 2 end while x > 3 do end return x < 2 end").text ==
          "function() local x = 1 if x > 1 then x = 2 end while x > 3 do end return h(4,h(0,x ,( 2))) end");
    CHECK(observe("f = function() return any(list, function() return a < 1 end) end").why ==
          "several functions begin on the line of the condition");
}

TEST_CASE("a condition with several lines keeps its line numbers", "[lua][scenario][condition]") {
    const ObservedSource found =
        observe("f(function()\n  return a -- first\n    < b\nend)", {.first_line = 1, .last_line = 4});
    CHECK(found.text == "function()\n  return h(0,a -- first\n    ,( b))\nend");
}

TEST_CASE("a condition that records comparisons has the result and the effects of the original",
          "[lua][scenario][condition]") {
    Tried tried(
        "local calls, limit = 0, 3\n"
        "local function count() calls = calls + 1; return calls, 'more' end\n"
        "return function() return count() < limit and limit <= (count()) + 5 end");
    CHECK(tried.sample());  // 1 < 3 and 3 <= 7
    REQUIRE(tried.condition->comparisons().size() == 2);
    CHECK(tried.condition->comparisons()[0].left_value == 1);
    CHECK(tried.condition->comparisons()[1].right_value == 7);
    CHECK_FALSE(tried.sample());  // 3 < 3
    CHECK_FALSE(tried.condition->comparisons()[1].evaluated);
}

TEST_CASE("touch of something that is not a robot gives Lua's own message", "[lua][scenario][condition]") {
    for (const char* const expression :
         {"mouse.collided", "not pair.mouse.collided", "(f()).collided", "mouse.mouse.collided"}) {
        CAPTURE(expression);
        const std::string text = fmt::format(
            "local mouse, pair, f = nil, {{}}, function() end\nreturn function() return {} end", expression);
        Tried tried(text);
        const auto held = tried.condition->sample(tried.state->lua());
        REQUIRE_FALSE(held);
        lua_State* const lua = tried.state->lua();
        REQUIRE(load_chunk(lua, *compile(text, "test.lua")));
        REQUIRE(protected_call(lua, 0, 1, {}));
        const auto plain = protected_call(lua, 0, 1, {});
        REQUIRE_FALSE(plain);
        CHECK(describe(held.error()) == describe(plain.error()));
    }
}

TEST_CASE("only the least robustness of a touch is exact, where only this is asked for", "[lua][scenario][condition]") {
    Tried tried("local mouse = { collided = false }\nreturn function() return not mouse.collided end");
    tried.texts.clearance = [](lua_State*, int, double most) { return std::optional(std::min(most, 0.3)); };
    const auto asked = [&](LeastAsked least) {
        REQUIRE(tried.condition->sample(tried.state->lua(), &least));
        return tried.condition->robustness().value;
    };
    CHECK(asked({}) == 0.3);
    CHECK(asked({.least = 0.2}) == 0.2);
    CHECK(asked({.least = 0.4}) == 0.3);
    CHECK(asked({.least = 0.2, .opposite = true}) == 0.3);  // of `never`, less clearance is more robust
    CHECK(tried.sample());
    CHECK(tried.condition->robustness().value == 0.3);
}

TEST_CASE("a helper that is made again in each sample is observed a limited number of times",
          "[lua][scenario][condition]") {
    Tried tried(
        "local a = 1\n"
        "return function()\n"
        "  local function near() return a < 4 end\n"
        "  return near()\n"
        "end");
    for (int i = 0; i < 100; ++i) CHECK(tried.sample());
    CHECK(tried.condition->robustness().decided->left == "near()");
}

TEST_CASE("the reason names the comparison that failed, and by how much", "[lua][scenario][condition]") {
    Tried tried("local pose, limit = { x = 0.75 }, 0.5\nreturn function() return pose.x < limit and pose.x > 0 end");
    CHECK_FALSE(tried.sample());
    CHECK(tried.condition->reason() == "pose.x < limit: pose.x was 0.75 m, limit was 0.5 m, off the limit by 0.25 m");
}

TEST_CASE("the reason names a comparison of a helper", "[lua][scenario][condition]") {
    Tried tried(
        "local gap = 0.75\nlocal function near() return gap < 0.5 end\n"
        "return function() return near() end");
    CHECK_FALSE(tried.sample());
    CHECK(tried.condition->reason() == "gap < 0.5: gap was 0.75, off the limit by 0.25");
}

TEST_CASE("compile-time constants do not become globals", "[lua][scenario][condition]") {
    Tried tried("local limit <const> = 3\nreturn function() return math.abs(-2) < limit end");
    CHECK(tried.sample());
}

TEST_CASE("an error in a condition has the line of its text", "[lua][scenario][condition]") {
    Tried tried("local nothing\n\nreturn function() return nothing < 3 end");
    const auto held = tried.condition->sample(tried.state->lua());
    REQUIRE_FALSE(held);
    CHECK(describe(held.error()) == "test.lua:3: attempt to compare nil with number");
}

TEST_CASE("a condition that returns nothing is an error", "[lua][scenario][condition]") {
    for (const char* text : {"return function() end", "local function f() end\nreturn function() return f() end"}) {
        Tried tried(text);
        const auto held = tried.condition->sample(tried.state->lua());
        REQUIRE_FALSE(held);
        CHECK(held.error().message == "the condition returned nothing: expected true or false");
    }
}
