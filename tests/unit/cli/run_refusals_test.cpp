// Pipes as files for results: what is refused is in tests/texts/commands/run_refusals.txt.
#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <utility>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

TEST_CASE("a pipe without a reader is refused as a file for results, and one with a reader is written", "[cli][run]") {
    const Scratch scratch;
    const std::string pipe = scratch.path("pipe").string(), drawing = scratch.path("pipe.svg").string();
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    REQUIRE(mkfifo(drawing.c_str(), 0600) == 0);
    const auto run = [](const std::string& option, const std::string& file) {
        return run_nezumi({"run", "behaviors/systems/stop_at_wall.lua", "--headless", "--speed", "max", "--duration",
                           "0.05", "--ports", "controller.out", "--record", "/dev/null", option, file});
    };
    for (const auto& [option, file] : {std::pair{"--journal", pipe}, {"--picture", drawing}}) {
        const Outcome outcome = run(option, file);
        CHECK(outcome.status == 2);
        CHECK(outcome.error == file + ": is a pipe without a reader: start its reader first, or give a file\n");
    }
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    REQUIRE(reader >= 0);
    CHECK(run("--journal", pipe).status == 0);
    char first = 0;
    CHECK(read(reader, &first, 1) == 1);
    CHECK(first == '{');
    close(reader);
}
