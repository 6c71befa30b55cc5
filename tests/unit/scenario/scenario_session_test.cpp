// Sessions: plans, filters, processes, hashes, failing samples, files of failures.
#include <catch2/catch.hpp>
#include <chrono>

#include "tests/unit/file_text.hpp"
#include "tests/unit/scenario/scenario_rig.hpp"

using namespace nezumi;

namespace {

constexpr const char* sweep =
    "scenario('drives', { sweep = { speed = { 0.1, 0.2 }, noise = { true, false } } }, function(s, p)\n"
    "  local w = s:load 'systems/stop_at_wall.lua'\n"
    "  w.controller.config.speed_x = p.speed + math.random() * 0.01\n"
    "  s:run(1)\n"
    "end)\n"
    "scenario('stands', function(s) s:robot 'mouse' { model = 'raspimouse' } s:run(1) end)\n";

std::vector<std::string> names(const TestPlan& plan) {
    std::vector<std::string> all;
    for (const PlannedRun& run : plan.runs) all.push_back(run.name);
    return all;
}

std::vector<std::string> tell(const SessionEnd& end) {
    std::vector<std::string> all;
    for (const RunReport& report : end.reports) all.push_back(report.name + " " + std::to_string(report.result.hash));
    return all;
}

}  // namespace

TEST_CASE("a plan has all combinations, sorted by key", "[lua][scenario][session]") {
    ScenarioRig rig(sweep);
    CHECK(names(rig.plan()) ==
          std::vector<std::string>{"drives [noise=true, speed=0.1]", "drives [noise=true, speed=0.2]",
                                   "drives [noise=false, speed=0.1]", "drives [noise=false, speed=0.2]", "stands"});
}

TEST_CASE("a filter matches parts of names, and a whole name matches only itself", "[lua][scenario][session]") {
    ScenarioRig rig(sweep);
    CHECK(rig.plan("speed=0.1").runs.size() == 2);
    CHECK(names(rig.plan("drives [noise=true, speed=0.2]")) ==
          std::vector<std::string>{"drives [noise=true, speed=0.2]"});
    CHECK(rig.plan("drives").runs.size() == 4);
    const auto none = plan_tests({.paths = {rig.folder().path("it_test.lua")}, .filter = "drivs"});
    REQUIRE_FALSE(none);
    CHECK(none.error().message == "no scenario matches 'drivs' (did you mean 'drives'?); --list shows all");
}

TEST_CASE("hashes are the same with every number of jobs and each time", "[lua][scenario][session]") {
    ScenarioRig rig(sweep);
    rig.options.jobs = 1;
    const SessionEnd serial = rig.session();
    CHECK(serial.status() == 0);
    CHECK(serial.summary.passed == 5);
    rig.options.jobs = 3;
    rig.options.repeat = 2;
    const SessionEnd parallel = rig.session();
    CHECK(parallel.status() == 0);
    CHECK(tell(parallel) == tell(serial));
    rig.options.seed = 125;
    CHECK_FALSE(tell(rig.session()) == tell(serial));
}

TEST_CASE("a failing sample is simplified, and its command repeats it", "[lua][scenario][session]") {
    ScenarioRig rig(
        "scenario('small', { sweep = { x = range(0, 100), y = range(-5, 5) }, samples = 30 }, function(s, p)\n"
        "  s:robot 'mouse' { model = 'raspimouse' }\n"
        "  s:run(0.1)\n"
        "  s:check(p.x < 20, 'too large')\n"
        "end)");
    rig.options.jobs = 2;
    const SessionEnd end = rig.session();
    CHECK(end.status() == 1);
    REQUIRE(end.reports.size() == 30);
    const RunReport* simplest = nullptr;
    for (const RunReport& report : end.reports) {
        if (report.result.outcome == RunOutcome::failed && simplest == nullptr) simplest = &report;
    }
    REQUIRE(simplest != nullptr);
    CHECK(simplest->name == "small [x=20.0, y=0.0]");
    CHECK(simplest->result.error.message == "check failed: too large");
    CHECK(simplest->again.ends_with("--filter 'small [x=20.0, y=0.0]' --seed 124"));
    CHECK(names(rig.plan(simplest->name)) == std::vector<std::string>{simplest->name});
    CHECK(rig.session(simplest->name).reports.front().result.hash == simplest->result.hash);
    // Of the others it is said once each that they are alike.
    CHECK(end.reports.back().result.outcome == RunOutcome::failed);
    CHECK(end.reports.back().result.facts ==
          std::vector<std::string>{"fails in the same line as the simplest failure: small [x=20.0, y=0.0]"});
}

TEST_CASE("a failure writes its text to a folder and names the folder", "[lua][scenario][session]") {
    ScenarioRig rig("scenario('a/b: \"c\"', function(s) s:check(false, 'no') end)");
    const SessionEnd end = rig.session();
    REQUIRE(end.reports.size() == 1);
    const RunResult& result = end.reports.front().result;
    CHECK(result.folder.starts_with(rig.folder().path("failures/it_test-a-b-c-").string()));
    const std::string text = text_of_file(std::filesystem::path(result.folder) / "failure.txt");
    CHECK(text.find("check failed: no\n") != std::string::npos);
    CHECK(text.find("seed: 124\n") != std::string::npos);
    CHECK(rig.said.find("files: " + result.folder) != std::string::npos);
}

TEST_CASE("a failure's text ends with one row for each condition", "[lua][scenario][session]") {
    ScenarioRig rig(R"(scenario("it", function(s)
  s:load "systems/stop_at_wall.lua"
  s:never("touches", function() return s.mouse.collided end)
  s:always("is slow", function() return s.mouse.truth.velocity.vx < 0.05 end)
  s:run(3)
end))");
    const SessionEnd end = rig.session();
    REQUIRE(end.reports.size() == 1);
    const std::string text = text_of_file(std::filesystem::path(end.reports.front().result.folder) / "failure.txt");
    INFO(text);
    const auto rows = text.find("\nconditions:\n  never 'touches': came within ");
    REQUIRE(rows != std::string::npos);
    CHECK(text.find("\n  always 'is slow': beyond the limit by ", rows) != std::string::npos);
}

TEST_CASE("a file that can't be read changes the status, and the other files run", "[lua][scenario][session]") {
    ScenarioRig rig(sweep);
    static_cast<void>(rig.folder().write("broken_test.lua", "scenario('x', function(s)\n"));
    static_cast<void>(rig.folder().write("empty_test.lua", "-- nothing\n"));
    const auto plan = plan_tests({.paths = {rig.folder().path("")}, .installed = rig.options.installed});
    REQUIRE(plan);
    REQUIRE(plan->files.size() == 3);
    REQUIRE(plan->files[0].errors.size() == 1);
    CHECK(plan->files[0].errors.front().message.find("'end' expected") != std::string::npos);
    REQUIRE(plan->files[1].errors.size() == 1);
    CHECK(plan->files[1].errors.front().message ==
          "the file has no scenario: expected scenario(\"name\", function(s) ... end)");
    CHECK(plan->runs.size() == 5);
}

TEST_CASE("a file of thousands of scenarios is read in time that grows with their number", "[scenario][wallclock]") {
    std::string text;
    for (int i = 0; i < 3000; ++i)
        text += "scenario('s" + std::to_string(i) + "', function(s)\n  s:check(true, 'x')\nend)\n";
    ScenarioRig rig(text);
    const auto begin = std::chrono::steady_clock::now();
    CHECK(rig.plan().runs.size() == 3000);
    CHECK(rig.run("s2999").outcome == RunOutcome::passed);
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(5));  // 0.1 s; quadratic: 30 s
}
