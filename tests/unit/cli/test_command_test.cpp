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

bool has_part(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

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

TEST_CASE("if a result file exceeds the file size limit, the error is reported and the old file stays", "[cli][test]") {
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
    CHECK(program.error == "nezumi: interrupted: not all scenarios have run; --resume runs the others\n");
    const auto resumed = tried.test({"it_test.lua", "--resume", "--filter", "n=1"});
    CHECK(resumed.status == 0);
    CHECK(kept() == 2);
}

TEST_CASE("an interrupted session reports all finished runs, in their order", "[cli][test][parts]") {
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
        CHECK(has_part(program.out, "\nok     it [n=3]  ("));
        CHECK(has_part(program.out, "\n2 runs: 1 passed, 1 failed (seed 124, "));
        CHECK(program.error == "nezumi: interrupted: not all scenarios have run; --resume runs the others\n");
        CHECK_THAT(text_of_file(tried.path("it.csv")),
                   Catch::Matches("scenario,run,seed,passed,n,doubled\nit,it \\[n=2\\],[0-9]+,false,2,4\n"
                                  "it,it \\[n=3\\],[0-9]+,true,3,6\n"));
        CHECK(has_part(text_of_file(tried.path("it.xml")), "tests=\"2\" failures=\"1\" errors=\"0\""));
    }
    std::signal(SIGHUP, before);
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
