// Sessions that go on where one was cut off, and sessions in parts.
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "bindings/scenario/measures.hpp"
#include "bindings/scenario/plan_file.hpp"
#include "bindings/scenario/result_store.hpp"
#include "engine/base/whole_file.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/scenario/scenario_rig.hpp"

using namespace nezumi;

namespace {

namespace fs = std::filesystem;

// Passes, fails and measures; a random sweep of which some fail; a word that can't be run.
constexpr const char* mixed =
    "scenario('drives', { sweep = { speed = { 0.1, 0.2, 0.3 } } }, function(s, p)\n"
    "  local w = s:load 'systems/stop_at_wall.lua'\n"
    "  w.controller.config.speed_x = p.speed\n"
    "  s:run(0.5)\n"
    "  s:measure('way', w.mouse.truth.pose.position.x, 'm')\n"
    "  s:check(p.speed < 0.25, 'too fast')\n"
    "end)\n"
    "scenario('drawn', { sweep = { x = range(0, 100) }, samples = 12 }, function(s, p)\n"
    "  s:measure('x', p.x)\n"
    "  print('x is', p.x)\n"
    "  s:check(p.x < 50, 'too large')\n"
    "end)\n"
    "scenario('can not', function(s) s:load 'no_such' end)\n";

struct PartsRig : ScenarioRig {
    explicit PartsRig(std::string_view text = mixed) : ScenarioRig(text) { options.keep = true; }

    // All that a session told, without the seconds that it took.
    std::string told(const SessionEnd& end) const {
        std::string text;
        for (const RunReport& report : end.reports) {
            text +=
                report.name + fmt::format(" {} {:016x}\n", static_cast<int>(report.result.outcome), report.result.hash);
            for (std::string line : failure_lines(report)) {
                // Each part leaves the files of failures in a folder of its own.
                if (line.starts_with("files: ")) line = "files: " + line.substr(line.rfind('/') + 1);
                text += "  " + line + "\n";
            }
            for (const std::string& line : report.result.printed) text += "  | " + line + "\n";
        }
        for (const MeasureSummary& measure : end.summary.measures) text += text_of(measure) + "\n";
        return text + measures_csv(end.measured);
    }

    fs::path part(std::size_t index) const { return folder().path(fmt::format("part-{}", index)); }

    SessionEnd make_part(std::size_t index, std::size_t count) {
        const TestPlan planned = plan();
        options.shard = {index, count};
        options.folder = part(index);
        options.made_with = fingerprint(planned, options.seed, "1", options.installed);
        const KeptPlan kept{.plan = planned,
                            .made_with = options.made_with,
                            .seed = options.seed,
                            .repeat = options.repeat,
                            .shards = count,
                            .words = ""};
        REQUIRE(keep_plan(options.folder, options.shard, kept));
        SessionEnd end = session();
        options.shard = {};
        return end;
    }

    SessionEnd merge(std::size_t count) const {
        std::vector<fs::path> folders;
        for (std::size_t i = 1; i <= count; ++i) folders.push_back(part(i));
        const auto kept = find_plan(folders);
        REQUIRE(kept);
        const auto reporter = console_reporter([](std::string_view) {}, false);
        return merge_tests(*kept, folders, *reporter);
    }
};

}  // namespace

TEST_CASE("the merged parts of a session give the report of the whole session", "[scenario][parts]") {
    PartsRig rig;
    rig.options.jobs = 2;
    const SessionEnd whole = rig.session();
    REQUIRE(whole.reports.size() == 16);
    std::size_t made = 0;
    for (std::size_t part = 1; part <= 3; ++part) {
        const SessionEnd end = rig.make_part(part, 3);
        made += end.reports.size();
        for (const RunReport& report : end.reports) {
            const auto same = [&](const RunReport& other) { return other.result.hash == report.result.hash; };
            CHECK(std::any_of(whole.reports.begin(), whole.reports.end(), same));
        }
    }
    CHECK(made == 16);
    const SessionEnd merged = rig.merge(3);
    CHECK(rig.told(merged) == rig.told(whole));
    CHECK(merged.status() == whole.status());
    CHECK(merged.summary.failed == whole.summary.failed);
    CHECK(merged.summary.seconds == whole.summary.seconds);
    // The files of a failure are named where they are.
    for (const RunReport& report : merged.reports) {
        if (!report.result.folder.empty()) CHECK(fs::is_directory(report.result.folder));
    }
}

TEST_CASE("the error about a missing run names the shard that makes it", "[scenario][parts]") {
    PartsRig rig;
    for (std::size_t part = 1; part <= 2; ++part) rig.make_part(part, 2);
    const PlannedRun second = rig.plan().runs[1];
    ResultStore(rig.part(2), rig.options.made_with)
        .forget({.file = rig.plan().files.front().shown, .run = second.name, .seed = second.seed});
    const SessionEnd merged = rig.merge(2);
    CHECK(merged.status() == 2);
    CHECK(merged.reports[1].name == "drives [speed=0.2]");
    CHECK(merged.reports[1].result.error.message ==
          "this run is missing: no folder has its result; --shard 2/2 --resume makes it");
    CHECK(merged.measured[1].measures.empty());

    rig.options.resume = true;
    rig.make_part(2, 2);
    CHECK(rig.merge(2).reports[1].result.outcome == RunOutcome::passed);
}

TEST_CASE("folders that are not parts of one session are refused", "[scenario][parts]") {
    PartsRig rig;
    rig.make_part(1, 2);
    rig.options.seed = 7;
    rig.make_part(2, 2);
    const auto other = find_plan({rig.part(1), rig.part(2)});
    REQUIRE_FALSE(other);
    CHECK(other.error().place.file == rig.part(2).string());
    CHECK(other.error().message ==
          "has other runs than " + rig.part(1).string() +
              ": merge parts that the same version of nezumi made from the same files, with the same options");
    const auto twice = find_plan({rig.part(1), rig.part(1) / "." / ""});
    REQUIRE_FALSE(twice);
    CHECK(describe(twice.error()) == (rig.part(1) / "." / "").string() + ": is given twice: leave out one of them");
    const auto none = find_plan({rig.folder().path("behaviors")});
    REQUIRE_FALSE(none);
    CHECK(none.error().message == "has no results of nezumi test --shard: expected a folder that it wrote with -o");
    rig.folder().write("part-1/results/plan-1-of-2", "nezumi plan 1\nand no more");
    CHECK(find_plan({rig.part(1)}).error().message == "has no plan that this version of nezumi can read");
    // A part that is made again takes the place of one of other runs.
    rig.make_part(1, 2);
    CHECK(find_plan({rig.part(1), rig.part(2)}));
}

TEST_CASE("a resumed session makes only the missing runs, and reports all", "[scenario][parts]") {
    PartsRig rig("scenario('counts', { sweep = { n = { 1, 2, 3, 4 } } }, function(s, p) s:measure('n', p.n) end)\n");
    const TestPlan plan = rig.plan();
    rig.options.made_with = 5;
    const ResultStore store(rig.options.folder, 5);
    const auto key = [&](std::size_t run) {
        return ResultKey{.file = plan.files.front().shown, .run = plan.runs[run].name, .seed = plan.runs[run].seed};
    };
    // One that was torn, and one that was made, as can be seen.
    REQUIRE(store.keep(key(2), {plan.runs[2].name, {.printed = {"kept"}}}));
    const fs::path torn = *fs::directory_iterator(ResultStore::folder_in(rig.options.folder));
    fs::resize_file(torn, fs::file_size(torn) - 1);
    REQUIRE(store.keep(key(1), {plan.runs[1].name, {.printed = {"kept"}}}));
    REQUIRE(store.find(key(1)));
    REQUIRE_FALSE(store.find(key(2)));

    rig.options.resume = true;
    std::size_t all = 0;
    rig.options.progress = [&](std::size_t, std::size_t count) { all = count; };
    const SessionEnd end = rig.session();
    CHECK(all == 3);
    REQUIRE(end.reports.size() == 4);
    CHECK(end.reports[1].result.printed == std::vector<std::string>{"kept"});
    CHECK(end.reports[2].result.printed.empty());
    CHECK(end.summary.kept == 1);
    CHECK(rig.said.find("4 runs: 4 passed (seed 124, 1 kept and 3 run now: 0.00 s simulated in ") != std::string::npos);
    all = 0;
    CHECK(rig.session().reports.size() == 4);
    CHECK(all == 0);  // nothing was left
    // What was made of other files is made again.
    rig.options.made_with = 6;
    CHECK(rig.session().reports[1].result.printed.empty());
    CHECK(all == 4);
}

TEST_CASE(
    "the fingerprint depends on the version, the seed, the project's behaviours and the files that a scenario may read",
    "[scenario][parts]") {
    PartsRig rig("scenario('it', function() end)\n");
    const auto now = [&](const std::string& version = "1", std::uint64_t seed = 1) {
        return fingerprint(rig.plan(), seed, version, rig.options.installed);
    };
    const std::uint64_t before = now();
    CHECK(now() == before);
    CHECK(now("2") != before);
    CHECK(now("1", 2) != before);
    for (const char* read : {"golden.csv", "map.yaml", "map.pgm", "floor.png", "system.lua"}) {
        INFO(read);
        const std::uint64_t without = now();
        rig.folder().write(read, "-- 1");
        const std::uint64_t with = now();
        CHECK(with != without);
        rig.folder().write(read, "-- 2");
        CHECK(now() != with);
        fs::remove(rig.folder().path(read));
    }
    CHECK(now() == before);
    rig.folder().write("behaviors/systems/map.csv", "x,y,z,lx,ly,lz,yaw");
    const std::uint64_t with_map = now();
    CHECK(with_map != before);
    rig.folder().write("behaviors/none.lua", "param('x', 2)");
    CHECK(now() != with_map);
}

TEST_CASE("files that sessions write do not change the fingerprint", "[scenario][parts]") {
    PartsRig rig("scenario('it', function() end)\n");
    const auto scenario = rig.folder().write("tests/scenarios/deep_test.lua", "scenario('deep', function() end)");
    const auto now = [&] {
        const auto planned = plan_tests({.paths = {scenario}, .installed = rig.options.installed});
        return fingerprint(planned.value(), 1, "1", rig.options.installed);
    };
    const std::uint64_t before = now();
    rig.folder().write("tests/log.txt", "PASS");
    rig.folder().write("tests/report.xml", "<testsuite/>");
    rig.folder().write("tests/measured.csv", measures_csv({{.scenario = "deep", .name = "deep"}}));
    rig.folder().write("tests/out/results/0123456789abcdef", "nezumi result 1\n");
    for (const char* left : {"failure.txt", "trace.csv", "picture.png"})
        rig.folder().write(std::string("tests/out/deep_test-deep/") + left, "of a failure");
    CHECK(now() == before);
    rig.folder().write("tests/goldens/deep.csv", "time,mouse.out\n");
    CHECK(now() != before);
}

TEST_CASE("a session leaves results only with the option keep, or if it is killed", "[scenario][parts]") {
    PartsRig rig(
        "scenario('counts', { timeout = 1e8, sweep = { n = { 1, 2, 3 } } }, function(s, p)\n"
        "  s:load 'systems/stop_at_wall.lua'\n"
        "  if p.n == 2 then s:run(1e7) end\n"
        "end)\n");
    rig.options.keep = false;
    rig.options.jobs = 2;
    CHECK(rig.session("n=1").status() == 0);
    CHECK_FALSE(fs::exists(rig.options.folder));

    const pid_t session = fork();
    if (session == 0) {
        rig.session();
        _exit(0);
    }
    const TestPlan plan = rig.plan();
    const ResultStore store(rig.options.folder, rig.options.made_with);
    const auto is_kept = [&](std::size_t run) {
        const PlannedRun& planned = plan.runs[run];
        return store.find({.file = plan.files.front().shown, .run = planned.name, .seed = planned.seed}).has_value();
    };
    for (int i = 0; i < 20'000 && !(is_kept(0) && is_kept(2)); ++i) usleep(1000);
    kill(session, SIGKILL);
    waitpid(session, nullptr, 0);
    CHECK(is_kept(0));
    CHECK_FALSE(is_kept(1));
    CHECK(is_kept(2));
}

TEST_CASE("a killed worker loses its run, which a resumed session makes again", "[scenario][parts]") {
    PartsRig rig(
        "scenario('loads', { sweep = { n = { 1, 2, 3 } } }, function(s, p)\n"
        "  if p.n == 2 then s:load 'systems/stop_at_wall.lua' end\n"
        "end)\n");
    const auto systems = rig.options.systems;
    rig.options.systems = []() -> LiveOptions {
        kill(getpid(), SIGKILL);
        return {};
    };
    const SessionEnd killed = rig.session();
    CHECK(killed.summary.passed == 2);
    REQUIRE(killed.reports.size() == 3);
    CHECK(killed.reports[1].result.error.message == "its process was ended by signal 9 (Killed)");

    rig.options.systems = systems;
    rig.options.resume = true;
    std::size_t made = 0;
    rig.options.progress = [&](std::size_t, std::size_t all) { made = all; };
    CHECK(rig.session().status() == 0);
    CHECK(made == 1);
}

TEST_CASE("a run whose result can't be stored counts as missing", "[scenario][parts]") {
    PartsRig rig("scenario('it', function() end)\n");
    rig.folder().write("failures", "a file");
    const SessionEnd end = rig.session();
    CHECK(end.status() == 2);
    CHECK(end.reports.front().result.error.message ==
          "the result of this run can't be kept: " + (rig.options.folder / "results").string() +
              ": can't be made: Not a directory");
    rig.options.keep = false;
    CHECK(rig.session().status() == 0);
}
