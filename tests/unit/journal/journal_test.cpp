// Whatever is done to a system is journaled, and a journal makes the same run again.
#include "bindings/journal/journal.hpp"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <sstream>
#include <thread>

#include "bindings/lua/sandbox/watchdog.hpp"
#include "engine/base/whole_file.hpp"
#include "tests/unit/environment.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/journal/random_run.hpp"
#include "tests/unit/journal/small_run.hpp"

using namespace nezumi;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

void check_replays(RandomRun& run, int ticks) {
    const std::uint64_t hash = run.run(ticks);
    const Replayed again = replay(run.journal_file());
    CHECK(again.error.empty());
    CHECK(hash_text(again.hash) == hash_text(hash));
}

template <std::size_t... kind>
std::set<std::string_view> all_kinds(std::index_sequence<kind...>) {
    return {Describe<std::variant_alternative_t<kind, Act>>::name...};
}

}  // namespace

TEST_CASE("a minute of random acts replays to the same hash", "[journal]") {
    RandomRun run(1);
    check_replays(run, 6000);
}

// Ten minutes; an hour in tests/long.
TEST_CASE("many random acts of every kind replay to the same hash", "[journal][acts][long]") {
    RandomRun run(2);
    check_replays(run, number_from_environment("NEZUMI_ACT_TICKS", 60'000));
    CHECK(run.done == all_kinds(std::make_index_sequence<std::variant_size_v<Act>>()));
}

TEST_CASE("the older journal has another name until the new one has its end, and its own again where no run began",
          "[journal]") {
    const Scratch folder;
    const fs::path file = folder.write("it.journal", "older\n");
    SECTION("a run that ends") {
        SmallRun run("function on_execute() end");
        run.journal = std::move(Journal::create(file).value());
        run.journal->begin(*run.live, journal_version, false);
        run.tick(3);
        CHECK(text_of_file(file.string() + "~") == "older\n");
        run.end();
        CHECK(Replay::read(file, journal_version));
        CHECK_FALSE(fs::exists(file.string() + "~"));
    }
    SECTION("a system that could not be read") {
        REQUIRE(Journal::create(file));
        CHECK(text_of_file(file) == "older\n");
        CHECK_FALSE(fs::exists(file.string() + "~"));
    }
}

TEST_CASE("a replay reads no file of the project", "[journal]") {
    RandomRun run(3);
    const std::uint64_t hash = run.run(1500);
    const Scratch other;
    const fs::path journal = other.path("run.journal");
    fs::copy_file(run.journal_file(), journal);
    SECTION("they are changed") { run.folder.write("behaviors/wanderer.lua", "error('another one')"); }
    SECTION("they are gone") { fs::remove_all(run.folder.path("")); }
    const Replayed again = replay(journal);
    CHECK(again.error.empty());
    CHECK(hash_text(again.hash) == hash_text(hash));
}

TEST_CASE("a replay looks into no folder of the project", "[journal]") {
    const std::string place = GENERATE("behaviors/it.lua", "it.lua");
    CAPTURE(place);
    const auto prepare = [&](const Scratch& folder) {
        fs::rename(folder.path("behaviors/it.lua"), folder.path(place));
        folder.write("behaviors/nothera.lua", "return 1");
        fs::resize_file(folder.write("behaviors/large.lua", ""), largest_text + 1);
        REQUIRE(mkfifo(folder.path("behaviors/pipe.lua").c_str(), 0600) == 0);
    };
    SmallRun run(R"(
local out = output("out", "TimedString")
local whys = ""
for _, name in ipairs { "nothere", "none.at.all", "large", "pipe" } do
  local _, why = pcall(require, name)
  whys = whys .. why .. "\n"
end
function on_execute() out:write(whys) end
)",
                 headless_budget, prepare);
    run.tick(5);
    const auto whys = run.live->system().port("it.out").value()->value().get<std::string>();
    CHECK_THAT(whys, Contains("there is no module 'nothere' (did you mean 'nothera'?)"));
    CHECK_THAT(whys, Contains("is larger than 16 MB"));
    CHECK_THAT(whys, Contains("pipe.lua is a FIFO, expected a file"));
    const std::uint64_t hash = run.end();
    SECTION("with other files in it") {
        run.folder.write("behaviors/nother.lua", "return 2");
        run.folder.write("behaviors/large.lua", "return 3");
        fs::remove(run.folder.path("behaviors/pipe.lua"));
    }
    SECTION("that is gone") { fs::remove_all(run.folder.path("behaviors")); }
    const Replayed again = replay(run.file);
    CHECK(again.error.empty());
    CHECK(hash_text(again.hash) == hash_text(hash));
}

TEST_CASE("a replay sees a folder empty that had files before", "[journal]") {
    const std::string script =
        "local out = output('out', 'TimedString')\nlocal _, why = pcall(require, 'nothere')\n"
        "function on_execute() out:write(why) end\n";
    SmallRun run(script, headless_budget,
                 [](const Scratch& folder) { folder.write("behaviors/lib/nothera.lua", "return 1"); });
    const auto why = [&] { return run.live->system().port("it.out").value()->value().get<std::string>(); };
    run.tick(3);
    CHECK_THAT(why(), Contains("did you mean 'nothera'?"));
    fs::remove(run.folder.path("behaviors/lib/nothera.lua"));
    run.folder.write("behaviors/it.lua", script + "-- again\n");
    REQUIRE(run.live->act(Reload{.files = {run.folder.path("behaviors/it.lua").string()}}, {}));
    run.tick(3);
    CHECK_THAT(why(), !Contains("did you mean"));
    const std::uint64_t hash = run.end();
    const Replayed again = replay(run.file);
    CHECK(again.error.empty());
    CHECK(hash_text(again.hash) == hash_text(hash));
}

TEST_CASE("a replay reads no map, robot file or table either", "[journal]") {
    const Scratch project, other;
    project.write("map.csv", "x,y,z,lx,ly,lz,yaw\n0.2,0,0.1,0.02,1,0.2,0\n");
    project.write("near.csv", "distance_m,value\n0.01,1000\n0.3,100\n");
    project.write("far_sighted.lua",
                  "return robot_model { base = 'raspimouse', sensors = { right_front = { table = 'near.csv' } } }");
    project.write("behaviors/it.lua",
                  "local range = input('in', 'TimedShortSeq', '') local out = output('out', 'TimedLong', '')\n"
                  "function on_execute() out:write(range:read()[1] or 0) end");
    const fs::path system = project.write("system.lua",
                                          "arena { csv 'map.csv' } robot 'mouse' { model = 'far_sighted' }\n"
                                          "behavior 'it' { script = 'it' } connect('mouse.ir_sensor_out', 'it.in')");
    LiveOptions options = RandomRun::makers();
    auto live = std::move(RunningSystem::load(system, std::move(options)).value());
    auto journal = std::move(Journal::create(other.path("it.journal")).value());
    journal->begin(*live, journal_version, false);
    live->activate();
    for (int i = 0; i < 20; ++i) live->tick();
    journal->end(RunEnd::duration, "", live->when(), live->trace_hash());
    CHECK(live->system().port("it.out").value()->value().get<std::int32_t>() > 400);  // by map and table

    fs::remove_all(project.path(""));
    const Replayed again = replay(other.path("it.journal"));
    CHECK(again.error.empty());
    CHECK(hash_text(again.hash) == hash_text(live->trace_hash()));
}

TEST_CASE("components that were loaded by another thread are replayed from the journal", "[journal]") {
    SmallRun run(counter);
    const auto add = [&](const std::string& name) {
        const fs::path path = run.folder.path("behaviors/" + name + ".lua");
        const Preparation prepare =
            run.live->prepare(Add{BehaviorEntry{.name = name, .script = name, .path = path.string()}});
        PreparedAct prepared;
        std::thread([&] { prepared = prepare(); }).join();
        REQUIRE(run.live->commit(std::move(prepared), {}));
        REQUIRE(run.live->act(Activate{name}, {}));
        run.tick(3);
    };
    const std::string script =
        "local n = require 'step' local out = output('out', 'TimedLong') "
        "function on_execute() out:write(n) end";
    run.folder.write("behaviors/first.lua", script);
    run.folder.write("behaviors/second.lua", script);
    run.folder.write("behaviors/step.lua", "return 7");
    run.tick(3);
    add("first");
    // A file that was there is there no longer: another one is found in its place, in the replay as well.
    fs::remove(run.folder.path("behaviors/step.lua"));
    run.folder.write("behaviors/lib/step.lua", "return 8");
    add("second");
    // What comes later is found in the project itself.
    run.folder.write("behaviors/lib/step.lua", "return 9");
    REQUIRE(run.live->act(Reload{.files = {run.folder.path("behaviors/lib/step.lua").string()}}, {}));
    run.tick(3);
    const std::uint64_t hash = run.end();
    fs::remove_all(run.folder.path("behaviors"));
    fs::remove(run.folder.path("system.lua"));
    const Replayed again = replay(run.file);
    CHECK(again.error.empty());
    CHECK(hash_text(again.hash) == hash_text(hash));
}

TEST_CASE("an act that was prepared before a restart is refused after it", "[journal]") {
    SmallRun run(counter);
    run.folder.write("behaviors/late.lua", counter);
    PreparedAct prepared = run.live->prepare(
        Add{BehaviorEntry{.name = "late", .script = "late", .path = run.folder.path("behaviors/late.lua").string()}})();
    REQUIRE(run.live->act(Restart{}, {}));
    CHECK_FALSE(run.live->fits(prepared));
    const auto added = run.live->commit(std::move(prepared), {});
    REQUIRE_FALSE(added);
    CHECK(added.error().message == "the system has changed while the files were read: try again");
}

TEST_CASE("a process that is killed leaves a journal that replays to its last whole line", "[journal]") {
    RandomRun run(4);
    const pid_t child = fork();
    if (child == 0) {
        run.run(1'000'000, [](Journal&) { return true; });
        _exit(1);
    }
    REQUIRE(child > 0);
    std::error_code none;
    while (fs::file_size(run.journal_file(), none) < 60'000 || none) {
        REQUIRE(waitpid(child, nullptr, WNOHANG) == 0);
        usleep(1000);
    }
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);

    // The line that is torn, as a machine that went down would leave it.
    std::string text = text_of_file(run.journal_file());
    text.resize(text.rfind('\n') + 1);
    run.folder.write("run.journal", text + R"({"at":[1,)");
    auto read = Replay::read(run.journal_file(), journal_version);
    REQUIRE(read);
    CHECK((*read)->torn_line() == std::count(text.begin(), text.end(), '\n') + 1);
    CHECK_FALSE((*read)->end());

    const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
    int start = 0;
    long long tick = 0;
    REQUIRE(std::sscanf(text.c_str() + last, "{\"at\":[%d,%lld", &start, &tick) == 2);
    const Replayed again = replay(run.journal_file());
    CHECK(again.error.empty());
    const bool restarts = text.find(R"("do":"Restart")", last) != std::string::npos;
    CHECK(again.end.start == start + (restarts ? 1 : 0));
    CHECK(again.end.tick == (restarts ? 0 : tick));
}

TEST_CASE("an act with a million numbers is written while ticks go on", "[journal][wallclock]") {
    SmallRun it("local port = input('in', 'TimedLongSeq', '') function on_execute() port:read() end");
    const auto act = std::make_shared<const PastAct>(
        PastAct{Inject{"it.in", std::vector<std::int32_t>(1'000'000, 12345)}, {Actor::Kind::console}});
    double spent = 1;
    for (int attempt = 0; attempt < 4; ++attempt) {
        const ActTime when = it.live->when();
        const std::int64_t before = thread_time();
        it.journal->acted(when, act, ActResult{});
        it.journal->serve();
        spent = std::min(spent, static_cast<double>(thread_time() - before) * 1e-9);
        it.tick();
    }
    it.end();
    CHECK(spent < 0.01);  // as text they are 6 MB
    CHECK(text_of_file(it.file).size() > 16'000'000);
}

TEST_CASE("a run whose files have names that are not UTF-8 replays from its journal", "[journal]") {
    const Scratch folder;
    folder.write("behaviors/it.lua", counter);
    folder.write("behaviors/base64:x", "");
    const fs::path system = folder.write("caf\xe9/syst\xe8me.lua", "behavior 'it' { script = 'it' }\n");
    const std::string script = folder.write("caf\xe9/compt\xe9.lua", counter).string();
    LiveOptions options;
    options.scripts = &lua_scripts();
    auto live = std::move(RunningSystem::load(system, std::move(options)).value());
    const fs::path file = folder.path("it.journal");
    auto journal = std::move(Journal::create(file).value());
    journal->begin(*live, journal_version, false);
    live->activate();
    const auto added = live->act(
        Add{BehaviorEntry{.name = "second", .script = "compt\xe9", .path = script, .place = {system.string(), 1}}}, {});
    REQUIRE(added);
    for (int i = 0; i < 10; ++i) live->tick();
    const std::uint64_t hash = live->trace_hash();
    journal->end(RunEnd::duration, "", live->when(), hash);
    const Replayed again = replay(file);
    CHECK(again.error.empty());
    CHECK(hash_text(again.hash) == hash_text(hash));
}
