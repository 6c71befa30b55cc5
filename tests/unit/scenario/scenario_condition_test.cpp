// Which comparisons are found in a condition's text, and what they have to do with the outcome.
#include <catch2/catch.hpp>

#include "bindings/lua/sandbox/compile.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/scenario/condition.hpp"
#include "bindings/scenario/condition_source.hpp"

using namespace nezumi;

namespace {

ObservedSource observe(std::string_view expression) {
    return observe_comparisons("local f = function() return " + std::string(expression) + " end", 1, 1, "h");
}

// A state with a condition: the text's result.
struct Tried {
    std::unique_ptr<LuaState> state = create_sandbox().value();
    std::string text;
    std::unique_ptr<Condition> condition;

    explicit Tried(std::string source) : text(std::move(source)) {
        lua_State* lua = state->lua();
        const auto chunk = compile(text, "test.lua");
        REQUIRE(chunk);
        REQUIRE(load_chunk(lua, *chunk));
        REQUIRE(protected_call(lua, 0, 1, {}));
        auto taken = Condition::take(lua, -1, &text);
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
    const ObservedSource found = observe("math.abs(a.velocity.vx) < limit");
    CHECK(found.text == "function() return h(0,math.abs(a.velocity.vx) ,( limit)) end");
    REQUIRE(found.comparisons.size() == 1);
    CHECK(found.comparisons[0].left == "math.abs(a.velocity.vx)");
    CHECK(found.comparisons[0].right == "limit");
    CHECK(found.comparisons[0].unit == "m/s");
    CHECK(found.comparisons[0].for_true);
    CHECK(found.comparisons[0].for_false);
}

TEST_CASE("and, or and not determine which comparison decides", "[lua][scenario][condition]") {
    const auto flags = [](std::string_view expression) {
        std::string out;
        for (const Comparison& c : observe(expression).comparisons) {
            out += out.empty() ? "" : " ";
            out += c.for_true ? "T" : "";
            out += c.for_false ? "F" : "";
            out += c.negated ? "n" : "";
            out += "-";
        }
        return out;
    };
    CHECK(flags("a < 1") == "TF-");
    CHECK(flags("a < 1 and b > 2") == "T- T-");
    CHECK(flags("a < 1 or b > 2") == "F- F-");
    CHECK(flags("not (a < 1 or b > 2)") == "Tn- Tn-");
    CHECK(flags("not (a < 1 and not (b > 2))") == "Fn- F-");
    CHECK(flags("a < 1 and (b > 2 or c == 3)") == "T- - -");
    CHECK(flags("f(a < 1)").empty());
    CHECK(flags("a < 1 == true").empty());
}

TEST_CASE("functions of another form are not changed", "[lua][scenario][condition]") {
    CHECK(observe("flag").text.empty());
    CHECK(observe("any(function() return a < 1 end)").text.empty());
    CHECK(observe_comparisons("f = function() local x = 1 return x < 2 end", 1, 1, "h").text.empty());
    CHECK(observe_comparisons("f = function(x) return x < 2 end", 1, 1, "h").text.empty());
    // Two in one line: which is meant can't be known.
    CHECK(
        observe_comparisons("f, g = function() return a < 2 end, function() return b < 2 end", 1, 1, "h").text.empty());
}

TEST_CASE("a condition with several lines keeps its line numbers", "[lua][scenario][condition]") {
    const ObservedSource found = observe_comparisons("f(function()\n  return a -- first\n    < b\nend)", 1, 4, "h");
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
    CHECK_FALSE(tried.condition->comparisons()[1].sampled);
}

TEST_CASE("the margin is the distance of the comparison nearest to its limit", "[lua][scenario][condition]") {
    Tried tried("local a, b = 0.25, 10\nreturn function() return a < 0.5 and b > 9.875 end");
    CHECK(tried.sample());
    const auto margin = margin_of(tried.condition->comparisons(), true);
    REQUIRE(margin);
    CHECK(margin->distance == 0.125);
    CHECK(text_of(*margin->comparison) == "b > 9.875");
}

TEST_CASE("the reason names the comparison that failed, and by how much", "[lua][scenario][condition]") {
    Tried tried("local pose, limit = { x = 0.75 }, 0.5\nreturn function() return pose.x < limit and pose.x > 0 end");
    CHECK_FALSE(tried.sample());
    CHECK(reason_of(tried.condition->comparisons(), false) ==
          "pose.x < limit: pose.x was 0.75 m, limit was 0.5 m, off the limit by 0.25 m");
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
    Tried tried("return function() end");
    const auto held = tried.condition->sample(tried.state->lua());
    REQUIRE_FALSE(held);
    CHECK(held.error().message == "the condition returned nothing: expected true or false");
}
