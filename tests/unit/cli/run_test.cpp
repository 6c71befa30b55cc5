// `nezumi run` as a script uses it: what it prints, what it writes, how it ends.
#include <catch2/catch.hpp>

#include <csignal>
#include <set>
#include <string>
#include <vector>

#include "tests/unit/cli/behavior_project.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

const std::string wall_system = "behaviors/systems/stop_at_wall.lua";

}  // namespace

TEST_CASE("commands that are cut off cost the exit status", "[cli][run]") {
    const Scratch files;
    files.write("commands", "\nprint('begins') run(1e8)\n");  // one line, as the signal may come before the next begins
    Program program({"run", "behaviors/systems/stop_at_wall.lua", "--batch"}, "", files.path("commands").string());
    REQUIRE(program.wait_for_output("begins"));
    program.send(SIGINT);
    CHECK(program.wait() == 1);
    CHECK(program.error.find("line 2: not run to its end: a signal ended the run\n") != std::string::npos);
}

TEST_CASE("a signal ends a run in good order: robots stopped, files complete, status 0", "[cli][run]") {
    const Scratch scratch;
    const std::string csv = scratch.path("trace.csv").string(), png = scratch.path("end.png").string();
    const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP);
    Program program({"run", wall_system, "--headless", "--trace-hash", "--record", csv, "--picture", png, "--ports",
                     "controller.out"});
    // The file is there before the first tick; some ticks later the mouse is on its way.
    for (int i = 0; i < 300 && !std::filesystem::exists(csv); ++i) usleep(10000);
    usleep(300000);
    program.send(signal);
    CHECK(program.wait() == 0);
    CHECK(program.out.substr(0, 12) == "trace hash: ");
    const auto lines = lines_of(text_of_file(csv));
    REQUIRE(lines.size() > 10);
    CHECK(lines[5].substr(lines[5].find(',')) == ",0.1,0,0");
    CHECK(lines.back().substr(lines.back().find(',')) == ",0,0,0");
    CHECK(text_of_file(png).size() > 1000);
}

TEST_CASE("a second signal ends a run at once", "[cli][run][watchdog]") {
    // Loading is over when this has been said, and the endless hook keeps the first signal waiting.
    const BehaviorProject project(R"(param("x", 1)
function on_execute() log.info("begins") while true do end end
)");
    Program program({"run", project.file, "--headless"});
    REQUIRE(program.wait_for_error("begins"));
    program.send(SIGINT);
    usleep(100000);
    program.send(SIGINT);
    CHECK(program.wait() == -SIGINT);
}

TEST_CASE("a saved behaviour is taken while a run goes on, but not in a headless one", "[cli][run]") {
    const BehaviorProject project(
        "param('x', 1)\nfunction on_activated() log.info('first') end\nfunction on_execute() end\n");
    const std::string second =
        "param('x', 1)\nfunction on_reload() log.info('second') end\nfunction on_execute() end\n";
    SECTION("with a terminal or without") {
        Program program({"run", project.file});
        REQUIRE(program.wait_for_error("first"));
        project.scratch.write("behaviors/it.lua", second);
        CHECK(program.wait_for_error("second"));
        program.send(SIGINT);
        CHECK(program.wait() == 0);
    }
    SECTION("headless") {
        Program program({"run", project.file, "--headless"});
        REQUIRE(program.wait_for_error("first"));
        project.scratch.write("behaviors/it.lua", second);
        CHECK_FALSE(program.wait_for_error("second", 0.5));
        program.send(SIGINT);
        CHECK(program.wait() == 0);
    }
}
