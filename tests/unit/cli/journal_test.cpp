// `nezumi run --journal` and `--replay` as a person uses them.
#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

// A project whose mouse stands on a picture of the floor, and commands that change it as they go.
struct Journaled {
    Journaled() {
        fs::create_directories(folder.path("behaviors"));
        fs::copy_file("tests/scenarios/stripes.png", folder.path("floor.png"));
        folder.write("behaviors/it.lua", R"(
local target = output("out", "TimedVelocity2D")
param("speed", 0.1)
command("double", function(x) config.speed = config.speed * 2 return x end)
function on_execute() target:write { vx = config.speed, va = math.random() } end
)");
        system = folder
                     .write("system.lua", R"(
arena { floor { image = "floor.png", size = { 2, 1 } } }
robot "mouse" { model = "raspimouse" }
behavior "it" { script = "it" }
connect("it.out", "mouse.target_velocity_in")
)")
                     .string();
        commands = folder
                       .write("commands", R"(step(10)
it.config.speed = 0.2
run(0.5) it:double(1)
hold(it.out, { vx = 0.05 }) step(3)
mouse:teleport { x = 0.3 }
restart()
run(0.3)
stop() run(1) rearm()
run(0.2)
)")
                       .string();
        journal = folder.path("run.journal").string();
    }
    Outcome run(std::vector<std::string> options, const std::string& input = "") const {
        options.insert(options.begin(), {"run", system, "--trace-hash"});
        return run_nezumi(options, "", input);
    }
    Scratch folder;
    std::string system, commands, journal;
};

std::string last_line(const std::string& text) { return text.substr(text.rfind('\n', text.size() - 2) + 1); }

}  // namespace

// They were written on 2026-11-28, 158 changes before this test: a reload, a parameter and a teleport.
TEST_CASE("a journal and a recording that an earlier nezumi has written are repeated to the same hash",
          "[cli][journal]") {
    for (const char* name : {"stop_at_wall.journal", "stop_at_wall.mcap"}) {
        INFO(name);
        const std::string file = source_root() + "/tests/golden/runs/" + name;
        const Outcome run = run_nezumi({"run", file, "--headless", "--speed", "max", "--trace-hash"});
        INFO(run.error);
        CHECK(run.status == 0);
        CHECK(run.out == "trace hash: 030cc99e57633222\n");
        CHECK(run_nezumi({"compare", file, file}).out == "equal: all messages published in 0.4 s\n");
    }
}

TEST_CASE("a run is replayed from its journal alone, and ends with the same hash", "[cli][journal]") {
    Journaled it;
    const Outcome first = it.run({"--batch", "--seed", "7", "--journal", it.journal}, it.commands);
    INFO(first.error);
    REQUIRE(first.status == 0);
    const fs::path kept = it.journal + ".kept";
    SECTION("with its files") {}
    SECTION("without them") {
        for (const char* gone : {"behaviors", "system.lua", "floor.png"}) fs::remove_all(it.folder.path(gone));
    }
    const Outcome again = it.run({"--replay", it.journal});
    INFO(again.error);
    CHECK(again.status == 0);
    CHECK(again.out == last_line(first.out));
}
