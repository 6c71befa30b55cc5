// `nezumi test` as a person or a script calls it: status, lists, files, signals.
#include <catch2/catch.hpp>
#include <csignal>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

constexpr const char* three =
    "scenario('passes', { sweep = { speed = { 0.1, 0.2 } } }, function(s, p)\n"
    "  local w = s:load 'systems/stop_at_wall.lua'\n"
    "  w.controller.config.speed_x = p.speed\n"
    "  s:run(0.5)\n"
    "end)\n"
    "scenario('fails', function(s)\n"
    "  s:load 'systems/stop_at_wall.lua'\n"
    "  s:always('stands', function() return s.mouse.truth.pose.position.x < 0.01 end)\n"
    "  s:run(5)\n"
    "end)\n"
    "scenario('can not', function(s) s:load 'no_such' end)\n";

// A folder with a file of scenarios.
struct Tried : Scratch {
    explicit Tried(std::string_view text = three) { static_cast<void>(write("it_test.lua", text)); }
    nezumi::Outcome test(std::vector<std::string> words) const {
        words.insert(words.begin(), "test");
        return run_nezumi(std::move(words), path("").string());
    }
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// How many processes one has begun that are not over.
std::size_t children_of(pid_t process) {
    const std::string number = std::to_string(process);
    std::ifstream children("/proc/" + number + "/task/" + number + "/children");
    std::size_t count = 0;
    for (pid_t child = 0; children >> child;) ++count;
    return count;
}

// The results that a session keeps.
std::size_t results_in(const std::filesystem::path& folder) {
    std::error_code none;
    std::size_t count = 0;
    for (std::filesystem::directory_iterator file(folder / "results", none), end; file != end; file.increment(none))
        count += file->path().extension().empty() ? 1 : 0;
    return count;
}

}  // namespace

TEST_CASE("nezumi test ends with 0, 1 or 2", "[cli][test]") {
    const Tried tried;
    CHECK(tried.test({"it_test.lua", "--filter", "passes"}).status == 0);
    CHECK(tried.test({"it_test.lua", "--filter", "fails"}).status == 1);
    CHECK(tried.test({"it_test.lua", "--filter", "can not"}).status == 2);
    CHECK(tried.test({"it_test.lua"}).status == 2);
    CHECK(tried.test({"it_test.lua", "--filter", "zzz"}).error ==
          "nezumi: no scenario matches 'zzz'; --list shows all\n");
    CHECK(tried.test({"it_test.lua", "--filter", "zzz"}).status == 2);
    CHECK(tried.test({"nothing"}).error == "nothing: there is no such file or folder\n");
    CHECK(tried.test({"it_test.lua", "--jobs", "0"}).status == 2);
    CHECK(tried.test({"it_test.lua", "--seed", "-1"}).error ==
          "nezumi: --seed: expected a whole number from 0 to 2^64 - 1, got '-1'; see nezumi test --help\n");
    CHECK(tried.test({"it_test.lua", "--junit", "none/it.xml"}).error ==
          "none/it.xml: can't be written: No such file or directory\n");
}

TEST_CASE("nezumi test --list shows every run and where it is", "[cli][test]") {
    const auto listed = Tried().test({"it_test.lua", "--list"});
    CHECK(listed.status == 0);
    CHECK(listed.out ==
          "passes [speed=0.1]  it_test.lua:1\n"
          "passes [speed=0.2]  it_test.lua:1\n"
          "fails  it_test.lua:6\n"
          "can not  it_test.lua:11\n");
}

TEST_CASE("nezumi test finds the scenarios of tests/ and behaviors/", "[cli][test]") {
    const Scratch folder;
    static_cast<void>(folder.write("tests/deep/a_test.lua", "scenario('a', function() end)"));
    static_cast<void>(folder.write("tests/helper.lua", "nonsense"));
    static_cast<void>(folder.write("behaviors/b_test.lua", "scenario('b', function() end)"));
    static_cast<void>(folder.write("tests/.hidden/c_test.lua", "scenario('c', function() end)"));
    const auto listed = run_nezumi({"test", "--list"}, folder.path("").string());
    CHECK(listed.out == "a  tests/deep/a_test.lua:1\nb  behaviors/b_test.lua:1\n");
    const auto inside = run_nezumi({"test", "--list"}, folder.path("tests").string());
    CHECK(contains(inside.out, "a  "));
    CHECK(contains(inside.out, "b  "));
}

TEST_CASE("a failure names its files and the command that repeats it", "[cli][test]") {
    const Tried tried;
    const auto failed = tried.test({"it_test.lua", "--filter", "fails", "-o", "out"});
    CHECK(contains(failed.out, "it_test.lua:8: always 'stands' held until "));
    CHECK(contains(failed.out, "off the limit by "));
    CHECK(contains(failed.out, "files: out/it_test-fails (trace.csv, picture.png, failure.txt)"));
    CHECK(contains(failed.out, "repeat it with: nezumi test it_test.lua --filter fails --seed 124"));
    CHECK(text_of_file(tried.path("out/it_test-fails/trace.csv")).starts_with("time,mouse."));
    CHECK(text_of_file(tried.path("out/it_test-fails/picture.png")).starts_with("\x89PNG"));
    CHECK(contains(text_of_file(tried.path("out/it_test-fails/failure.txt")), "seed: 124"));
}

TEST_CASE("a failure whose folder can't be made says so and is a failure", "[cli][test]") {
    const Tried tried;
    static_cast<void>(tried.write("out", "a file"));
    const auto failed = tried.test({"it_test.lua", "--filter", "fails", "-o", "out"});
    CHECK(failed.status == 1);
    CHECK(contains(failed.out, "the folder out/it_test-fails can't be made: Not a directory"));
    CHECK_FALSE(contains(failed.out, "files: "));
}

TEST_CASE("the same runs give the same hashes with any number of jobs", "[cli][test]") {
    const Tried tried;
    const auto hashes = [&](const std::string& jobs) {
        std::string out;
        std::istringstream lines(tried.test({"it_test.lua", "--filter", "passes", "--jobs", jobs}).out);
        for (std::string line; std::getline(lines, line);) {
            const std::size_t at = line.find("hash ");
            if (at != std::string::npos) out += line.substr(at) + "\n";
        }
        return out;
    };
    const std::string serial = hashes("1");
    CHECK(std::count(serial.begin(), serial.end(), '\n') == 2);
    CHECK(hashes("4") == serial);
    CHECK(tried.test({"it_test.lua", "--filter", "passes", "--repeat", "3"}).status == 0);
}

TEST_CASE("results go to JUnit and TAP", "[cli][test]") {
    const Tried tried;
    const auto told = tried.test({"it_test.lua", "--tap", "--junit", "it.xml"});
    CHECK(told.out.starts_with("TAP version 13\n1..4\nok 1 - it_test.lua: passes [speed=0.1]\n"));
    CHECK(contains(told.out, "\nnot ok 3 - it_test.lua: fails\n  ---\n"));
    const std::string xml = text_of_file(tried.path("it.xml"));
    CHECK(contains(xml, "<testsuite name=\"it_test.lua\" tests=\"4\" failures=\"1\" errors=\"1\""));
    CHECK(xml.ends_with("</testsuites>\n"));
}

TEST_CASE("nezumi test --measures writes a row for each run", "[cli][test]") {
    const Tried tried(
        "scenario('drives', { sweep = { speed = { 0.1, 0.2 } } }, function(s, p)\n"
        "  s:measure('doubled', 2 * p.speed, 'm/s')\n"
        "  s:check(p.speed < 0.15, 'too fast')\n"
        "end)\n");
    const auto told = tried.test({"it_test.lua", "--measures", "it.csv"});
    CHECK(told.status == 1);
    CHECK(contains(told.out, "\ndoubled [m/s] of drives: 2 runs, min 0.2, median 0.3, mean 0.3, max 0.4\n"));
    CHECK_THAT(text_of_file(tried.path("it.csv")),
               Catch::Matches("scenario,run,seed,passed,speed,doubled\n"
                              "drives,drives \\[speed=0.1\\],[0-9]+,true,0.1,0.2\n"
                              "drives,drives \\[speed=0.2\\],[0-9]+,false,0.2,0.4\n"));
    CHECK(tried.test({"it_test.lua", "--measures", "none/it.csv"}).error ==
          "none/it.csv: can't be written: No such file or directory\n");
}

TEST_CASE("nezumi test --seeds and --paired repeat each combination, and compare", "[cli][test][seeds]") {
    const Tried tried(
        "scenario('drives', { sweep = { controller = { 'a', 'b' } } }, function(s, p)\n"
        "  s:measure('own', s.seed)\n"
        "  s:check(s.seed < 3, 'wrong')\n"
        "end)\n");
    const auto told = tried.test({"it_test.lua", "--seeds", "2..3", "--measures", "it.csv"});
    CHECK(told.status == 1);
    CHECK(contains(told.out,
                   "repeat it with: nezumi test it_test.lua --filter 'drives [controller=a] seed 3' --seeds 3..3\n"));
    CHECK(text_of_file(tried.path("it.csv")) ==
          "scenario,run,seed,passed,controller,own\n"
          "drives,drives [controller=a] seed 2,2,true,a,2\n"
          "drives,drives [controller=a] seed 3,3,false,a,3\n"
          "drives,drives [controller=b] seed 2,2,true,b,2\n"
          "drives,drives [controller=b] seed 3,3,false,b,3\n");
    const auto again = tried.test({"it_test.lua", "--filter", "drives [controller=a] seed 3", "--seeds", "3..3"});
    CHECK(contains(again.out, "1 run: 0 passed, 1 failed ("));
    CHECK(contains(tried.test({"it_test.lua", "--paired", "controller"}).out,
                   "\nown of drives, controller=b minus controller=a: 1 pair, min 0, median 0, mean 0, max 0 "
                   "(less in 0, more in 0)\n"));
    for (const char* wrong : {"3", "3..2", "1..x", "-1..2", "1..200000", ".."}) {
        CHECK(tried.test({"it_test.lua", "--seeds", wrong}).error ==
              "nezumi: --seeds: expected the first and the last of at most 100000 seeds, as in 1..250, got '" +
                  std::string(wrong) + "'\n");
    }
}

TEST_CASE("results that are beyond a file's limit are told, and the file before stays", "[cli][test]") {
    const Tried tried;
    static_cast<void>(tried.write("it.xml", "before"));
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit less{100, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &less);
    const auto told = tried.test({"it_test.lua", "--filter", "passes", "--junit", "it.xml"});
    setrlimit(RLIMIT_FSIZE, &before);
    CHECK(told.status == 2);
    CHECK(told.error == "it.xml: can't be written: File too large\n");
    CHECK(text_of_file(tried.path("it.xml")) == "before");
    CHECK_FALSE(std::filesystem::exists(tried.path("it.xml.new")));
}

TEST_CASE("nezumi test --quiet says nothing of runs that pass", "[cli][test]") {
    const Tried tried;
    const auto passed = tried.test({"it_test.lua", "--filter", "passes", "--quiet"});
    CHECK(passed.status == 0);
    CHECK(passed.out.starts_with("2 runs: 2 passed (seed 124, "));
    const auto failed = tried.test({"it_test.lua", "--quiet"});
    CHECK(failed.out.starts_with("FAILED fails\n"));
    CHECK(contains(failed.out, "\ncould not run can not\n"));
    CHECK_FALSE(contains(failed.out, "passes"));
    CHECK(tried.test({"it_test.lua", "--tap", "--quiet"}).error ==
          "nezumi: --tap tells of every run: leave out --quiet\n");
}

TEST_CASE("parts of a session are merged to what the whole would have told", "[cli][test][parts]") {
    const Tried tried;
    const auto whole = tried.test({"it_test.lua", "--tap", "--measures", "whole.csv"});
    CHECK_FALSE(std::filesystem::exists(tried.path("nezumi-test/results")));
    CHECK(tried.test({"it_test.lua", "--shard", "1/2", "--list"}).out ==
          "passes [speed=0.1]  it_test.lua:1\nfails  it_test.lua:6\n");
    CHECK(tried.test({"it_test.lua", "--shard", "1/2", "-o", "one"}).status == 1);
    const auto missing = tried.test({"--merge", "one", "--quiet"});
    CHECK(missing.status == 2);
    CHECK(contains(missing.out,
                   "could not run passes [speed=0.2]\n    this run is missing: no folder has its result; "
                   "--shard 2/2 --resume makes it\n"));
    CHECK(contains(tried.test({"--merge", "one", "--tap"}).out, "\n  at: \"it_test.lua:1\"\n"));
    CHECK(tried.test({"it_test.lua", "--shard", "2/2", "-o", "two"}).status == 2);
    const auto merged = tried.test({"--merge", "one", "two", "--tap", "--measures", "it.csv", "--junit", "it.xml"});
    CHECK(merged.status == whole.status);
    const auto without_folder = [](std::string text) {
        for (const std::string folder : {"nezumi-test/", "one/"}) {
            const std::string place = "files: ";
            const auto at = text.find(place + folder);
            if (at != std::string::npos) text.erase(at + place.size(), folder.size());
        }
        return text;
    };
    CHECK(without_folder(merged.out) == without_folder(whole.out));
    CHECK(text_of_file(tried.path("it.csv")) == text_of_file(tried.path("whole.csv")));
    CHECK(contains(text_of_file(tried.path("it.xml")), "tests=\"4\" failures=\"1\" errors=\"1\""));
    CHECK(contains(tried.test({"--merge", "one", "two"}).out, " s simulated elsewhere, merged from 2 folders)\n"));
}

TEST_CASE("nezumi test --resume makes nothing twice", "[cli][test][parts]") {
    const Tried tried("scenario('it', { sweep = { n = { 1, 2 } } }, function(s) s:check(true) end)\n");
    CHECK(tried.test({"it_test.lua", "--resume"}).status == 0);
    // A result says when it was written; one that is taken again is not written again.
    const auto results = tried.path("nezumi-test/results");
    std::vector<std::filesystem::file_time_type> before;
    for (const auto& file : std::filesystem::directory_iterator(results)) before.push_back(file.last_write_time());
    CHECK(before.size() == 2);
    const auto again = tried.test({"it_test.lua", "--resume"});
    CHECK(again.status == 0);
    CHECK(contains(again.out, "2 runs: 2 passed (seed 124, 2 kept and 0 made: "));
    std::vector<std::filesystem::file_time_type> after;
    for (const auto& file : std::filesystem::directory_iterator(results)) after.push_back(file.last_write_time());
    CHECK(after == before);
}

TEST_CASE("an interrupted session says that it can go on, and does", "[cli][test][parts]") {
    const Tried tried(
        "scenario('long', { timeout = 1e8, sweep = { n = { 1, 2, 3 } } }, function(s, p)\n"
        "  s:load 'systems/stop_at_wall.lua'\n"
        "  if p.n == 3 then s:run(1e7) end\n"
        "end)\n");
    Program program({"test", "it_test.lua", "--jobs", "1"}, tried.path("").string());
    const auto kept = [&] { return results_in(tried.path("nezumi-test")); };
    for (int i = 0; i < 20'000 && kept() < 2; ++i) usleep(1000);
    program.send(SIGINT);
    CHECK(program.wait() == 2);
    CHECK(program.error == "nezumi: interrupted: not all scenarios have run; --resume goes on with the others\n");
    const auto resumed = tried.test({"it_test.lua", "--resume", "--filter", "n=1"});
    CHECK(resumed.status == 0);
    CHECK(kept() == 2);
}

TEST_CASE("an interrupted session tells of all runs that were over, in their order", "[cli][test][parts]") {
    const Tried tried(
        "scenario('it', { timeout = 1e8, sweep = { n = { 1, 2, 3 } } }, function(s, p)\n"
        "  s:load 'systems/stop_at_wall.lua'\n"
        "  if p.n == 1 then s:run(1e7) end\n"
        "  s:measure('doubled', 2 * p.n)\n"
        "  s:check(p.n ~= 2, 'no')\n"
        "end)\n");
    const auto before = std::signal(SIGHUP, SIG_DFL);  // nohup ignores it
    for (const int signal : {SIGINT, SIGHUP}) {
        Program program({"test", "it_test.lua", "--jobs", "2", "--junit", "it.xml", "--measures", "it.csv", "-o",
                         std::to_string(signal)},
                        tried.path("").string());
        // Only the first run is not over.
        const auto kept = [&] { return results_in(tried.path(std::to_string(signal))); };
        for (int i = 0; i < 20'000 && (kept() < 2 || children_of(program.process()) > 1); ++i) usleep(1000);
        program.send(signal);
        CHECK(program.wait() == 2);
        CHECK(program.out.starts_with("FAILED it [n=2]\n    it_test.lua:5: check failed: no\n"));
        CHECK(contains(program.out, "\nok     it [n=3]  ("));
        CHECK(contains(program.out, "\n2 runs: 1 passed, 1 failed (seed 124, "));
        CHECK(program.error == "nezumi: interrupted: not all scenarios have run; --resume goes on with the others\n");
        CHECK_THAT(text_of_file(tried.path("it.csv")),
                   Catch::Matches("scenario,run,seed,passed,n,doubled\nit,it \\[n=2\\],[0-9]+,false,2,4\n"
                                  "it,it \\[n=3\\],[0-9]+,true,3,6\n"));
        CHECK(contains(text_of_file(tried.path("it.xml")), "tests=\"2\" failures=\"1\" errors=\"0\""));
    }
    std::signal(SIGHUP, before);
}

TEST_CASE("what can't be said of parts is refused", "[cli][test][parts]") {
    const Tried tried;
    for (const std::string wrong : {"0/2", "3/2", "2", "1/", "a/b", "1/2x", "-1/2"}) {
        CHECK(tried.test({"it_test.lua", "--shard", wrong}).error ==
              "nezumi: --shard: expected a part K/N with K from 1 to N, as in 2/5, got '" + wrong + "'\n");
    }
    CHECK(tried.test({"--merge"}).error ==
          "nezumi: --merge: expected the folders of the parts, as in nezumi test --merge part-*\n");
    CHECK(tried.test({"--merge", "none"}).error ==
          "none: has no results of nezumi test --shard: expected a folder that one wrote by -o\n");
    CHECK(tried.test({"--merge", "one", "--shard", "1/2"}).error ==
          "nezumi: --merge tells of runs that others have made: leave out --shard\n");
    CHECK(tried.test({"--merge", "one", "--filter", "x"}).error ==
          "nezumi: --merge tells of runs that others have made: leave out --filter\n");
    for (const std::string option : {"--seed", "--repeat", "--jobs"}) {
        CHECK(tried.test({"--merge", "one", option, "124"}).error ==
              "nezumi: --merge tells of runs that others have made: leave out " + option + "\n");
    }
    CHECK(tried.test({"--merge", "one", "-o", "two"}).error ==
          "nezumi: --merge tells of runs that others have made: leave out -o\n");
    CHECK(tried.test({"it_test.lua", "--update-goldens", "--resume"}).error ==
          "nezumi: --update-goldens: every run has to be made: leave out --resume\n");
    CHECK(tried.test({"it_test.lua", "--hw", "--shard", "1/2"}).error ==
          "nezumi: --hw: a real robot is never the same twice: leave out --shard\n");
}

TEST_CASE("an interruption ends all runs at once", "[cli][test]") {
    const Tried tried(
        "scenario('long', { timeout = 1e8, sweep = { n = { 1, 2, 3 } } }, function(s)\n"
        "  s:load 'systems/stop_at_wall.lua'\n"
        "  s:run(1e7)\n"
        "end)\n");
    Program program({"test", "it_test.lua", "--jobs", "2"}, tried.path("").string());
    // When its runs have begun it reads its signals; before, one would end it as any program.
    for (int i = 0; i < 20'000 && children_of(program.process()) == 0; ++i) usleep(1000);
    program.send(SIGINT);
    CHECK(program.wait() == 2);
    CHECK(program.error == "nezumi: interrupted: not all scenarios have run\n");
}
