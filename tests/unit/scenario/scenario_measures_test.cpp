// What runs measure: kept, refused, summed up, written as CSV.
#include "bindings/scenario/measures.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/scenario/scenario_rig.hpp"

using namespace nezumi;

namespace {

MeasuredRun measured(const std::string& name, double value, const std::string& unit = "s") {
    return {.scenario = "a", .name = name, .point = {}, .passed = true, .measures = {{"time", value, unit}}};
}

}  // namespace

TEST_CASE("a run records a number for each name, also without a world and if it fails", "[scenario][measures]") {
    ScenarioRig rig(
        "scenario('it', function(s)\n"
        "  s:measure('count', 3)\n"
        "  s:measure('time to goal', 1.5, 's')\n"
        "  s:check(false, 'no')\n"
        "  s:measure('never', 1)\n"
        "end)");
    const RunResult result = rig.run();
    CHECK(result.outcome == RunOutcome::failed);
    CHECK(result.measures == std::vector<Measure>{{"count", 3, ""}, {"time to goal", 1.5, "s"}});
    CHECK(from_bytes(to_bytes(result)).value().measures == result.measures);
}

TEST_CASE("quantiles are interpolated as in R and NumPy", "[scenario][measures]") {
    CHECK(quantile({7}, 0.25) == 7);
    CHECK(quantile({1, 2, 3, 4}, 0.25) == 1.75);
    CHECK(quantile({1, 2, 3, 4}, 0.5) == 2.5);
    CHECK(quantile({1, 2, 3, 4, 10}, 0.75) == 4);
    CHECK(quantile({1, 2}, 0) == 1);
    CHECK(quantile({1, 2}, 1) == 2);
}

TEST_CASE("a summary has one line for each measure of a scenario", "[scenario][measures]") {
    const auto all = summarize({measured("x", 4), measured("y", 1), measured("z", 1.5), measured("z", 9, "m")});
    REQUIRE(all.size() == 2);
    CHECK(text_of(all[0]) == "time [s] of a: 3 runs, min 1, median 1.5, mean 2.16667, max 4");
    CHECK(text_of(all[1]) == "time [m] of a: 1 run, min 9, median 9, mean 9, max 9");
}

TEST_CASE("the table has a row for each run, and each column once", "[scenario][measures]") {
    const auto text = [](std::string value) {
        PlainData data;
        data.values.emplace_back(std::move(value));
        return to_sweep_value(std::move(data));
    };
    MeasuredRun first = measured("a [kind=\"x,y\", time=now]", 0.1);
    first.point = {{"kind", text("x,y")}, {"time", text("now")}};
    first.seed = 7;
    MeasuredRun second{
        .scenario = "b", .name = "b", .point = {{"seed", text("s")}}, .seed = 8, .passed = false, .measures = {}};
    CHECK(measures_csv({first, second}) ==
          "scenario,run,seed,passed,kind,p.time,p.seed,time\n"
          "a,\"a [kind=\"\"x,y\"\", time=now]\",7,true,\"x,y\",now,,0.1\n"
          "b,b,8,false,,,s,\n");
    CHECK(measures_csv({}) == "scenario,run,seed,passed\n");
}

TEST_CASE("a session summarizes the measures of the planned runs", "[scenario][measures][session]") {
    ScenarioRig rig(
        "scenario('it', { sweep = { x = range(0, 100) }, samples = 9 }, function(s, p)\n"
        "  s:measure('x', p.x, 'm')\n"
        "  s:check(p.x < 20, 'too large')\n"
        "end)");
    const SessionEnd end = rig.session();
    REQUIRE(end.measured.size() == 9);
    for (const MeasuredRun& run : end.measured) {
        REQUIRE(run.measures.size() == 1);
        CHECK(run.name == "it [x=" + run.point.front().second.text + "]");
        CHECK(run.passed == (run.measures.front().value < 20));
    }
    CHECK(rig.said.find("\nx [m] of it: 9 runs, min ") != std::string::npos);
}

TEST_CASE("no two columns of the table have the same name", "[scenario][measures]") {
    const auto text = [](const std::string& value) { return SweepValue{.data = {}, .text = value}; };
    MeasuredRun run = measured("x", 4);
    run.point = {{"a", text("1")}, {"p.a", text("2")}, {"run", text("3")}};
    run.measures = {{"a", 5, ""}, {"p.a", 6, ""}};
    CHECK(measures_csv({run}) == "scenario,run,seed,passed,p.p.a,p.p.p.a,p.run,a,p.a\na,x,0,true,1,2,3,5,6\n");
}
