// Runs that are stopped, or killed, from outside.
#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using Catch::Matchers::Contains;

namespace {

// A mouse in an arena, and a behaviour that says when it is.
struct StalledProject {
    StalledProject() {
        scratch.write("behaviors/it.lua", R"(
local out = output("out", "TimedVelocity2D")
param("speed", 0.1)
function on_execute()
  out:write { vx = config.speed, va = math.random() }
  log.info("at " .. now())
end
)");
        system = scratch
                     .write("system.lua",
                            "robot 'mouse' { model = 'raspimouse' }\nbehavior 'it' { script = 'it' }\n"
                            "connect('it.out', 'mouse.target_velocity_in')\n")
                     .string();
    }
    Scratch scratch;
    std::string system;
};

// The time of the last tick that a run has told [s].
double last_told(const std::string& text) {
    const auto at = text.rfind(" at ");
    return at == std::string::npos ? -1 : std::atof(text.c_str() + at + 4);
}

}  // namespace

TEST_CASE("a run that was stopped for 2 s goes on without catching up", "[cli][run][wallclock]") {
    const StalledProject project;
    Program program({"run", project.system, "--headless", "--duration", "1"});
    REQUIRE(program.wait_for_error(" at 0.2"));
    const auto begin = std::chrono::steady_clock::now();
    program.send(SIGSTOP);
    std::this_thread::sleep_for(std::chrono::seconds(2));
    program.send(SIGCONT);
    CHECK(program.wait() == 0);
    INFO(program.error.substr(program.error.rfind('\n', program.error.size() - 2) + 1));
    // What was left of its 1 s comes after the stop at its usual pace.
    CHECK(std::chrono::steady_clock::now() - begin > std::chrono::milliseconds(2500));
    std::smatch found;
    REQUIRE(std::regex_search(program.error, found, std::regex("ticks left out: (\\d+)\n")));
    CHECK(std::stoi(found[1]) >= 190);
    CHECK_THAT(program.error, !Contains("endless loop"));  // a call's time is that of its thread
}

TEST_CASE("a run that is killed leaves recording and journal whole up to 0.1 s before, and is replayed to there",
          "[cli][journal][wallclock]") {
    const StalledProject project;
    for (const int signal : {SIGKILL, SIGSEGV}) {
        CAPTURE(signal);
        const std::string csv = project.scratch.path("run.csv").string(),
                          journal = project.scratch.path("run.j").string(),
                          again = project.scratch.path("again.csv").string();
        double told = 0;
        {
            Program program({"run", project.system, "--headless", "--duration", "60", "--seed", "3", "--record", csv,
                             "--journal", journal});
            REQUIRE(program.wait_for_error(" at 0.7"));
            CHECK(run_nezumi({"attach", std::to_string(program.process()), "--eval", "it.config.speed = 0.2"}).status ==
                  0);
            REQUIRE(program.wait_for_error(" at 1.5"));
            program.send(signal);
            CHECK(program.wait() == -signal);
            told = last_told(program.error);
        }
        REQUIRE(told >= 1.5);
        const auto rows = lines_of(text_of_file(csv));
        REQUIRE(rows.size() > 100);
        const auto cells = std::count(rows[0].begin(), rows[0].end(), ',');
        for (const std::string& row : rows) CHECK(std::count(row.begin(), row.end(), ',') == cells);
        CHECK(std::atof(rows.back().c_str()) > told - 0.1);

        const Outcome replayed = run_nezumi({"run", project.system, "--replay", journal, "--record", again});
        INFO(replayed.error);
        CHECK(replayed.status == 0);
        CHECK_THAT(replayed.error,
                   Contains("has no end: the original run was interrupted, so this one stops at the same tick"));
        const auto same = lines_of(text_of_file(again));
        REQUIRE(same.size() > 100);
        CHECK(std::atof(same.back().c_str()) > told - 0.1);
        for (std::size_t i = 0; i < std::min(rows.size(), same.size()); ++i) CHECK(rows[i] == same[i]);
    }
}
