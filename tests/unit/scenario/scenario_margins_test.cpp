// Margins over time, worked by hand, and over the runs of a session: lines, summary, table.
#include "bindings/scenario/margins.hpp"

#include <catch2/catch.hpp>

#include "bindings/scenario/margin_watch.hpp"
#include "tests/unit/scenario/scenario_rig.hpp"

using namespace nezumi;

namespace {

using Kind = Expectation::Kind;

// The margin after these robustnesses, in samples of 0.1 s from 0.1 s on, until the expectation is decided.
ConditionMargin watched(Expectation::Terms terms, const std::vector<double>& values, double deadline = 10) {
    static const Comparison limit{.left = "x", .right = "1", .unit = "m"};
    Expectation expectation(std::move(terms), 0);
    MarginWatch watch;
    double now = 0;
    for (const double value : values) {
        now += 0.1;
        const bool is_true = value > 0;
        expectation.add_sample(is_true, now);
        watch.add(expectation, {value, &limit}, is_true, now, deadline);
        if (expectation.verdict() != Verdict::open) break;
    }
    return watch.result(expectation, "");
}

std::string shown(const ConditionMargin& margin) {
    if (!margin.margin) return "none: " + margin.why;
    std::string text = fmt::format("{:.6g} at {:.6g}", *margin.margin, margin.time);
    return margin.left ? text + fmt::format(", {:.6g} left", *margin.left) : text;
}

constexpr double infinite = std::numeric_limits<double>::infinity();

MeasuredRun run_with(const std::string& name, std::vector<ConditionMargin> margins) {
    return {.scenario = "a", .name = name, .point = {}, .seed = 7, .passed = true, .measures = {}, .margins = margins};
}

ConditionMargin always(double margin, double time) {
    return {
        .kind = "always", .condition = "keeps off", .margin = margin, .unit = "m", .comparison = "x < 1", .time = time};
}

// A scenario whose margins depend on its sweep, and one that has none.
constexpr const char* two_scenarios =
    "scenario('drives', { sweep = { speed = { 0.1, 0.2 } } }, function(s, p)\n"
    "  local w = s:load 'systems/stop_at_wall.lua'\n"
    "  w.controller.config.speed_x = p.speed\n"
    "  s:always('keeps off', function() return w.mouse.truth.pose.position.x < 0.5 end)\n"
    "  s:never('touches', function() return w.mouse.collided end)\n"
    "  s:eventually('goes', { within = 2 }, function() return w.mouse.truth.pose.position.x > 0.05 end)\n"
    "  s:run(0.5)\n"
    "end)\n"
    "scenario('stands', function(s)\n"
    "  local w = s:load 'systems/stop_at_wall.lua'\n"
    "  s:maintain('holds', { hold = 0.1, within = 1 }, function() return w.controller.status == 'ACTIVE' end)\n"
    "end)\n";

}  // namespace

TEST_CASE("always has the least margin over time, never that of the opposite", "[scenario][margins]") {
    CHECK(shown(watched({.kind = Kind::always}, {3, 1, 2})) == "1 at 0.2");
    CHECK(shown(watched({.kind = Kind::always}, {3, 1, -0.5})) == "-0.5 at 0.3");
    CHECK(shown(watched({.kind = Kind::always}, {infinite, 2, infinite})) == "2 at 0.2");
    CHECK(shown(watched({.kind = Kind::always}, {infinite})) == "none: x < 1: does not compare numbers");
    CHECK(shown(watched({.kind = Kind::always}, {})) == "none: the condition was not evaluated");
    CHECK(shown(watched({.kind = Kind::never}, {-3, -1, -2})) == "1 at 0.2");
    CHECK(shown(watched({.kind = Kind::never}, {-3, 0.25})) == "-0.25 at 0.2");
}

TEST_CASE("eventually has the greatest margin until the event, and the time that was left", "[scenario][margins]") {
    CHECK(shown(watched({.kind = Kind::eventually, .within = 1}, {-3, -1, -2, 0.5}, 1)) == "0.5 at 0.4, 0.6 left");
    CHECK(shown(watched({.kind = Kind::wait_until, .within = 0.3}, {-3, -1, -2}, 0.3)) == "-1 at 0.2");
    // It was still open when the run ended.
    CHECK(shown(watched({.kind = Kind::eventually}, {-3, -1, -2})) == "-1 at 0.2");
    // Without numbers, the time that was left is the margin.
    CHECK(shown(watched({.kind = Kind::eventually, .within = 1}, {-infinite, infinite}, 1)) == "0.8 at 0.2, 0.8 left");
    CHECK(shown(watched({.kind = Kind::eventually, .within = 0.2}, {-infinite, -infinite}, 0.2)) ==
          "none: x < 1: does not compare numbers");
}

TEST_CASE("maintain has the least margin of its hold", "[scenario][margins]") {
    const Expectation::Terms hold{.kind = Kind::maintain, .within = 1, .hold = 0.2};
    CHECK(shown(watched(hold, {3, 1, 2}, 1)) == "1 at 0.2, 0.9 left");
    // A hold that begins at the limit counts from where its margin no longer grows.
    CHECK(shown(watched(hold, {-1, 0.1, 0.5, 0.25}, 1)) == "0.25 at 0.4, 0.8 left");
    CHECK(shown(watched(hold, {-1, 0.1, 0.5, 0.75}, 1)) == "0.75 at 0.4, 0.8 left");
    // Not kept: what ended the longest hold, or what came nearest to a hold.
    CHECK(shown(watched(hold, {2, 2, -0.5, 2, -3, -4, -4, -4, -4, -4}, 1)) == "-0.5 at 0.3");
    CHECK(shown(watched(hold, {-3, -1, -2, -3, -3, -3, -3, -3, -3, -3}, 1)) == "-1 at 0.2");
    CHECK(shown(watched(hold, {1}, 1)) == "none: the run ended during the hold");
}

TEST_CASE("a line of the report says how near a condition came to failing", "[scenario][margins]") {
    CHECK(text_of(always(0.25, 1.5)) == "always 'keeps off': came within 0.25 m of the limit at 1.50 s (x < 1)");
    CHECK(text_of(always(-0.25, 1.5)) == "always 'keeps off': beyond the limit by 0.25 m at 1.50 s (x < 1)");
    CHECK(text_of(ConditionMargin{.kind = "never", .condition = "a", .why = "b is true or false"}) ==
          "never 'a': no margin: b is true or false");
    CHECK(text_of(ConditionMargin{
              .kind = "eventually", .condition = "a", .margin = 0.1, .comparison = "x > 1", .time = 4, .left = 1.5}) ==
          "eventually 'a': 1.50 s before its deadline, at 4.00 s");
    CHECK(text_of(ConditionMargin{.kind = "maintain", .condition = "a", .margin = 1, .time = 2, .left = 1}) ==
          "maintain 'a': began 1.00 s before its deadline");
}

TEST_CASE("the summary has the least margin of each condition, and its run", "[scenario][margins]") {
    ConditionMargin stops{
        .kind = "eventually", .condition = "stops", .margin = 0.001, .comparison = "v < 1", .time = 2, .left = 3};
    const ConditionMargin none{.kind = "never", .condition = "touches", .why = "b is true or false"};
    std::vector<MeasuredRun> runs{run_with("a [x=1]", {always(0.5, 1), stops, none})};
    CHECK(summarize_margins(runs).empty());  // its own lines say the same
    stops.left = 0.5;
    runs.push_back(run_with("a [x=2]", {always(0.25, 2), stops, none}));
    runs.push_back(run_with("a [x=3]", {always(-1, 3)}));
    runs.back().counts = false;
    const auto all = summarize_margins(runs);
    REQUIRE(all.size() == 3);
    CHECK(text_of(all[0]) == "always 'keeps off' of a: least margin of 2 runs 0.25 m, at 2.00 s of a [x=2]");
    CHECK(text_of(all[1]) == "eventually 'stops' of a: least time left of 2 runs 0.50 s, at 2.00 s of a [x=2]");
    CHECK(text_of(all[2]) == "never 'touches' of a: no margin: b is true or false");
    runs.push_back(run_with(
        "a [x=4]", {{.kind = "eventually", .condition = "stops", .margin = -2, .comparison = "v < 1", .time = 9},
                    {.kind = "always", .condition = "keeps off", .why = "the condition was not evaluated"}}));
    CHECK(text_of(summarize_margins(runs)[0]) ==
          "always 'keeps off' of a: least margin of 3 runs 0.25 m, at 2.00 s of a [x=2] (1 without a margin: the "
          "condition was not evaluated)");
    CHECK(text_of(summarize_margins(runs)[1]) ==
          "eventually 'stops' of a: least margin of 3 runs -2, at 9.00 s of a [x=4]; least time left of 3 runs 0.50 s, "
          "at 2.00 s of a [x=2]");
}

TEST_CASE("the table of margins has a row for each run and condition", "[scenario][margins]") {
    const std::string text = margins_csv(
        {run_with("a [x=1]", {always(0.5, 1.25), {.kind = "eventually", .condition = "b, c", .time = 2, .left = 3}}),
         run_with("a [x=2]", {{.kind = "never", .condition = "d", .why = "e is true or false"}})});
    CHECK(text ==
          "scenario,run,seed,condition,kind,margin,unit,time,left,why\n"
          "a,a [x=1],7,keeps off,always,0.5,m,1.25,,\n"
          "a,a [x=1],7,\"b, c\",eventually,,,2,3,\n"
          "a,a [x=2],7,d,never,,,0,,e is true or false\n");
    CHECK(is_margins_csv(text));
    CHECK_FALSE(is_margins_csv(measures_csv({})));
}

TEST_CASE("a robot that touches something is at the limit", "[scenario][margins]") {
    ScenarioRig rig(
        "scenario('it', function(s)\n"
        "  local w = s:load 'systems/stop_at_wall.lua'\n"
        "  w.controller:deactivate()\n"
        "  s:hold(w.mouse.target_velocity_in, { vx = 0.4 })\n"
        "  s:never('touches', function() return w.mouse.collided end)\n"
        "  s:run(10)\n"
        "end)");
    const RunResult result = rig.run();
    CHECK(result.outcome == RunOutcome::failed);
    CHECK(result.margins.at(0).margin == 0.0);
    CHECK(result.margins.at(0).time > 1);
}

TEST_CASE("a margin is the least clearance, however the condition is written", "[scenario][margins]") {
    ScenarioRig rig(
        "scenario('it', function(s)\n"
        "  local w = s:load 'systems/stop_at_wall.lua'\n"
        "  w.controller.config.speed_x = 0.2\n"
        "  s:always('a', function() return not w.mouse.collided end)\n"
        "  s:never('b', function() return w.mouse.collided end)\n"
        "  s:always('c', function() return w.mouse.truth.pose.position.x < 9 and not w.mouse.collided end)\n"
        "  s:never('d', function() return not not w.mouse.collided or w.mouse.truth.pose.position.x > 9 end)\n"
        "  s:always('e', function() if w.mouse.collided then return false end return true end)\n"
        "  s:run(3) w.controller.config.speed_x = -0.2 s:run(2)\n"
        "end)");
    const RunResult result = rig.run();
    REQUIRE(result.margins.size() == 5);
    const ConditionMargin& exact = result.margins[4];  // of a branch, each sample is exact
    REQUIRE(exact.margin);
    CHECK(exact.margin.value() < 0.6);
    for (const ConditionMargin& margin : result.margins) {
        CHECK(margin.margin == exact.margin);
        CHECK(margin.time == exact.time);
    }
}

TEST_CASE("a session reports margins for any number of jobs", "[scenario][margins][session]") {
    ScenarioRig rig(two_scenarios);
    rig.options.jobs = 1;
    const SessionEnd one = rig.session();
    CHECK(one.summary.passed == 3);
    REQUIRE(one.measured.size() == 3);
    REQUIRE(one.measured[0].margins.size() == 3);
    const ConditionMargin& keeps_off = one.measured[0].margins[0];
    CHECK(keeps_off.comparison == "w.mouse.truth.pose.position.x < 0.5");
    CHECK(keeps_off.margin.value() > 0.35);
    CHECK(keeps_off.unit == "m");
    const ConditionMargin& touches = one.measured[0].margins[1];
    CHECK(touches.comparison == "w.mouse.collided");
    CHECK(touches.margin.value() > 0.3);
    CHECK(touches.margin.value() < 1);
    CHECK(touches.unit == "m");
    CHECK(one.measured[0].margins[2].left.value() > 1);
    CHECK(one.measured[2].margins[0].margin == one.measured[2].margins[0].left);
    CHECK(rig.said.find("\nalways 'keeps off' of drives: least margin of 2 runs 0.") != std::string::npos);
    CHECK(rig.said.find("\neventually 'goes' of drives: least time left of 2 runs 1.") != std::string::npos);
    CHECK(rig.said.find("of drives [speed=0.1]\n") != std::string::npos);
    CHECK(rig.said.find("\n    never 'touches': came within 0.") != std::string::npos);
    rig.options.jobs = 3;
    CHECK(margins_csv(rig.session().measured) == margins_csv(one.measured));
}
