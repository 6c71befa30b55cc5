// Seeds: each run has its own, several a combination, the same for what is compared in pairs.
#include <catch2/catch.hpp>
#include <set>

#include "tests/unit/scenario/scenario_rig.hpp"

using namespace nezumi;

namespace {

constexpr const char* measures_draws =
    "  s:measure('own', s.seed)\n"
    "  s:measure('draw', math.random())\n"
    "end)";

TestPlan planned(ScenarioRig& rig, PlanOptions options) {
    options.paths = {rig.folder().path("it_test.lua")};
    options.installed = rig.options.installed;
    auto plan = plan_tests(options);
    INFO((plan ? "" : describe(plan.error())));
    REQUIRE(plan);
    return std::move(*plan);
}

SessionEnd made(ScenarioRig& rig, const TestPlan& plan) {
    rig.said.clear();
    const auto reporter = console_reporter([&rig](std::string_view more) { rig.said += more; }, false);
    return run_tests(plan, rig.options, *reporter);
}

std::vector<std::string> names_of(const TestPlan& plan) {
    std::vector<std::string> names;
    for (const PlannedRun& run : plan.runs) names.push_back(run.name);
    return names;
}

}  // namespace

TEST_CASE("every combination and every random sample has its own seed", "[scenario][seeds]") {
    for (const char* sweep :
         {"sweep = { x = { 1, 2, 3 }, y = { 1, 2 } }", "sweep = { x = range(0, 1) }, samples = 6"}) {
        ScenarioRig rig("scenario('it', { " + std::string(sweep) + " }, function(s, p)\n" + measures_draws);
        const SessionEnd end = rig.session();
        REQUIRE(end.measured.size() == 6);
        std::set<double> own, draws;
        for (const MeasuredRun& run : end.measured) {
            CHECK(static_cast<double>(run.seed) == run.measures[0].value);
            own.insert(run.measures[0].value);
            draws.insert(run.measures[1].value);
        }
        CHECK(own.size() == 6);
        CHECK(draws.size() == 6);
    }
}

TEST_CASE("runs of a sweep have different noise, and the same run has the same noise", "[scenario][seeds]") {
    ScenarioRig rig(
        "scenario('it', { sweep = { x = { 1, 2 } } }, function(s, p)\n"
        "  s:load('systems/stop_at_wall.lua', { robots = { mouse = { noise = 0.2 } } }) s:run(4)\n"
        "end)");
    const SessionEnd end = rig.session();
    REQUIRE(end.reports.size() == 2);
    CHECK(end.reports[0].result.hash != end.reports[1].result.hash);
    CHECK(rig.session().reports[1].result.hash == end.reports[1].result.hash);
    rig.options.seed = 125;
    CHECK(rig.session().reports[1].result.hash != end.reports[1].result.hash);
}

TEST_CASE("seeds = N makes each combination N times, each with another seed", "[scenario][seeds]") {
    ScenarioRig rig("scenario('it', { seeds = 3, sweep = { x = { 1, 2 } } }, function(s, p)\n" +
                    std::string(measures_draws));
    const TestPlan plan = planned(rig, {.seed = 124});
    CHECK(names_of(plan) == std::vector<std::string>{"it [x=1] #1", "it [x=1] #2", "it [x=1] #3", "it [x=2] #1",
                                                     "it [x=2] #2", "it [x=2] #3"});
    std::set<std::uint64_t> seeds;
    for (const PlannedRun& run : plan.runs) seeds.insert(run.seed);
    CHECK(seeds.size() == 6);
    const SessionEnd end = made(rig, plan);
    CHECK(end.measured[4].seed == plan.runs[4].seed);
    CHECK_THAT(rig.said, Catch::Contains("draw of it: 6 runs, "));
}

TEST_CASE("the option --seeds A..B makes each combination with each of these seeds", "[scenario][seeds]") {
    ScenarioRig rig("scenario('it', { seeds = 9, sweep = { x = { 1, 2 } } }, function(s, p)\n" +
                    std::string(measures_draws));
    const TestPlan plan = planned(rig, {.seed = 124, .seeds = SeedRange{5, 6}});
    CHECK(names_of(plan) ==
          std::vector<std::string>{"it [x=1] seed 5", "it [x=1] seed 6", "it [x=2] seed 5", "it [x=2] seed 6"});
    const SessionEnd end = made(rig, plan);
    REQUIRE(end.measured.size() == 4);
    CHECK(end.measured[1].measures[0].value == 6);
    CHECK(end.measured[1].seed == 6);
}

TEST_CASE("a seed in the scenario is used for all its runs", "[scenario][seeds]") {
    ScenarioRig rig("scenario('it', { seed = 7, sweep = { x = { 1, 2 } } }, function(s)\n" +
                    std::string(measures_draws));
    for (const PlanOptions& options : {PlanOptions{.seed = 124}, {.seed = 3}, {.seeds = SeedRange{1, 5}}}) {
        const SessionEnd end = made(rig, planned(rig, options));
        REQUIRE(end.measured.size() == 2);
        for (const MeasuredRun& run : end.measured) CHECK(run.measures[0].value == 7);
        CHECK(end.measured[0].measures[1].value == end.measured[1].measures[1].value);
    }
}

TEST_CASE("the command that repeats a run makes the same run", "[scenario][seeds]") {
    ScenarioRig rig(
        "scenario('drawn', { seeds = 2, sweep = { x = range(0, 1) }, samples = 2 }, function(s) s:check(false) end)\n"
        "scenario('listed', { sweep = { x = { 1, 2 } } }, function(s) s:check(false) end)");
    const TestPlan derived = planned(rig, {.seed = 9});
    for (const PlannedRun& run : derived.runs) {
        const RunReport report = report_of(derived, run, {}, {.seed = 9});
        CHECK_THAT(report.again, Catch::Contains(shell_text(run.name)) && Catch::EndsWith(" --seed 9"));
        CHECK(report.seed == run.seed);
        const TestPlan again = planned(rig, {.filter = run.name, .seed = 9});
        REQUIRE(again.runs.size() == 1);
        CHECK(again.runs[0].seed == run.seed);
    }
    const TestPlan given = planned(rig, {.seed = 9, .seeds = SeedRange{1, 3}});
    for (const PlannedRun& run : given.runs) {
        const std::uint64_t seed = run.seed;
        CHECK_THAT(report_of(given, run, {}, {.seed = 9}).again,
                   Catch::EndsWith(" --seeds " + std::to_string(seed) + ".." + std::to_string(seed)));
        const TestPlan again = planned(rig, {.filter = run.name, .seeds = SeedRange{seed, seed}});
        REQUIRE(again.runs.size() == 1);
        CHECK(again.runs[0].seed == seed);
        CHECK(again.runs[0].name == run.name);
    }
    // All repetitions of one combination, by the name without them.
    CHECK(planned(rig, {.filter = "listed [x=2]", .seeds = SeedRange{1, 3}}).runs.size() == 3);
}

TEST_CASE("the simplest failure is reported with its own seed and command", "[scenario][seeds]") {
    ScenarioRig rig(
        "scenario('it', { sweep = { x = range(0, 100) } }, function(s, p)\n"
        "  print('own ' .. s.seed) s:check(p.x < 10, 'large')\n"
        "end)");
    const SessionEnd end = rig.session();
    const auto failed = std::find_if(end.reports.begin(), end.reports.end(),
                                     [](const auto& each) { return !each.result.folder.empty(); });
    REQUIRE(failed != end.reports.end());
    CHECK(failed->result.printed == std::vector<std::string>{"own " + std::to_string(failed->seed)});
    CHECK(planned(rig, {.filter = failed->name, .seed = rig.options.seed}).runs[0].seed == failed->seed);
    CHECK_THAT(rig.said, Catch::Contains("    seed of this run: " + std::to_string(failed->seed) + "\n"));
}

TEST_CASE("runs that are compared in pairs have the same seed, and their differences are reported",
          "[scenario][seeds][paired]") {
    const std::string body =
        "function(s, p) s:measure('time', (p.controller == 'new' and 1 or 2) + 8 * math.random(), 's') end)";
    ScenarioRig rig(
        "scenario('it', { seeds = 4, paired = 'controller', sweep = { controller = { 'old', 'new' }, x = { 1, "
        "2 } } }, " +
        body);
    const TestPlan plan = rig.plan();
    REQUIRE(plan.runs.size() == 16);
    for (std::size_t i = 0; i < 8; ++i) CHECK(plan.runs[i].seed == plan.runs[i + 8].seed);
    CHECK(plan.runs[0].seed != plan.runs[1].seed);
    CHECK(plan.runs[0].seed != plan.runs[4].seed);
    made(rig, plan);
    CHECK_THAT(rig.said, Catch::Contains("\ntime [s] of it, controller=new minus controller=old: 8 pairs, min -1, "
                                         "quartiles -1 and -1, median -1 (95 % interval -1 to -1), mean -1, max -1; "
                                         "less in 8, more in 0 (sign test: p = 0.00781)\n"));

    ScenarioRig unpaired("scenario('it', { sweep = { controller = { 'old', 'new' } } }, " + body);
    const TestPlan apart = unpaired.plan();
    CHECK(apart.runs[0].seed != apart.runs[1].seed);
    const TestPlan together = planned(unpaired, {.seed = 124, .paired = "controller"});
    CHECK(together.runs[0].seed == together.runs[1].seed);
    const auto kept = plan_from_bytes(to_bytes(KeptPlan{.plan = together})).value();
    CHECK(kept.plan.runs[1].seed == together.runs[1].seed);
    CHECK(kept.plan.files[0].scenarios[0].paired == "controller");
}

TEST_CASE("draws that are compared in pairs are the same for each value", "[scenario][seeds][paired]") {
    ScenarioRig rig(
        "scenario('it', { paired = 'controller', samples = 5, sweep = { a = range(0, 1), controller = { 'old', 'new' "
        "}, "
        "x = range(0, 1) } }, function(s, p) s:measure('x', p.x) end)");
    const TestPlan plan = rig.plan();
    REQUIRE(plan.runs.size() == 10);
    for (std::size_t i = 0; i < 10; i += 2) {
        CHECK(without(plan.runs[i].point, "controller") == without(plan.runs[i + 1].point, "controller"));
        CHECK(plan.runs[i].point[1].second.text == "old");
        CHECK(plan.runs[i + 1].point[1].second.text == "new");
        CHECK(plan.runs[i].seed == plan.runs[i + 1].seed);
    }
    made(rig, plan);
    CHECK_THAT(rig.said, Catch::Contains("x of it, controller=new minus controller=old: 5 pairs, min 0, "));
}
