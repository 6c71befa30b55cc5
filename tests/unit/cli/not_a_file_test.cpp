// A FIFO in place of each file that a run reads: nothing waits for a writer that may never come.
#include <catch2/catch.hpp>

#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

// A project in which everything that a system can name is named.
struct NotAFileProject {
    NotAFileProject() {
        scratch.write("behaviors/it.lua", "require 'module' function on_execute() end\n");
        scratch.write("behaviors/module.lua", "return 1\n");
        std::string text = text_of_file("engine/robots/raspimouse.lua");
        text.replace(text.find("ir_table.csv"), 12, "my_table.csv");  // not the installed one
        scratch.write("robot.lua", text);
        fs::copy_file("engine/robots/ir_table.csv", scratch.path("my_table.csv"));
        scratch.write("map.csv", "x,y,z,lx,ly,lz,yaw\n1,0,0.1,0.1,1,0.2,0\n");
        scratch.write("part.lua", "return 1\n");
        fs::copy_file("tests/scenarios/stripes.png", scratch.path("floor.png"));
        scratch.write("system.lua",
                      "require 'part'\n"
                      "arena { floor { image = 'floor.png', size = { 2, 1 } }, csv 'map.csv' }\n"
                      "robot 'mouse' { model = 'robot' }\n"
                      "behavior 'it' { script = 'it' }\n");
    }
    Outcome run(std::vector<std::string> words) const {
        words.insert(words.begin(), "run");
        return run_nezumi(std::move(words), scratch.path("").string());
    }
    Outcome run() const { return run({"system.lua", "--headless", "--speed", "max", "--duration", "0.1"}); }
    void make_fifo(const std::string& name) const {
        fs::remove(scratch.path(name));
        REQUIRE(mkfifo(scratch.path(name).c_str(), 0600) == 0);
    }
    Scratch scratch;
};

}  // namespace

TEST_CASE("a FIFO in place of a file that a run reads is refused at once, and the error names its kind", "[cli][run]") {
    NotAFileProject project;
    const Outcome whole = project.run();
    INFO(whole.error);
    REQUIRE(whole.status == 0);
    for (const std::string name : {"system.lua", "behaviors/it.lua", "behaviors/module.lua", "robot.lua",
                                   "my_table.csv", "map.csv", "floor.png", "part.lua"}) {
        CAPTURE(name);
        const NotAFileProject other;
        other.make_fifo(name);
        const Outcome refused = other.run();
        CHECK(refused.status == 2);
        CHECK_THAT(refused.error, Contains(name + " is a FIFO, expected a file\n") ||
                                      Contains(name + ": is a FIFO, expected a file\n"));
        CHECK(refused.error.ends_with("is a FIFO, expected a file\n"));
    }
    project.make_fifo("journal");
    CHECK(project.run({"system.lua", "--replay", "journal"}).error == "journal: is a FIFO, expected a file\n");
}

TEST_CASE("a FIFO to be checked or tested is refused at once", "[cli][check]") {
    const NotAFileProject project;
    const std::string folder = project.scratch.path("").string();
    project.make_fifo("fifo.lua");
    CHECK_THAT(run_nezumi({"check", "fifo.lua"}, folder).error, Contains("fifo.lua: is a FIFO, expected a file\n"));
    project.make_fifo("fifo_test.lua");
    const Outcome tested = run_nezumi({"test", "fifo_test.lua"}, folder);
    CHECK(tested.status == 2);
    CHECK_THAT(tested.error + tested.out, Contains("fifo_test.lua: is a FIFO, expected a file"));
}

TEST_CASE("a run whose script becomes a FIFO goes on, refuses to restart, and ends", "[cli][run][wallclock]") {
    NotAFileProject project;
    fs::create_directory(project.scratch.path("runtime"));
    setenv("XDG_RUNTIME_DIR", project.scratch.path("runtime").c_str(), 1);
    Program program({"run", "system.lua"}, project.scratch.path("").string());
    const auto attach = [](const std::string& text) { return run_nezumi({"attach", "--eval", text}); };
    for (int tries = 0; tries < 300 && run_nezumi({"attach", "--list"}).status != 0; ++tries) usleep(100'000);
    project.make_fifo("behaviors/it.lua");
    CHECK(program.wait_for_error("behaviors/it.lua: is a FIFO, expected a file: the loaded version continues"));
    const Outcome reload = attach("reload()");
    CHECK(reload.status == 1);
    CHECK_THAT(reload.error, Contains("behaviors/it.lua: is a FIFO, expected a file; still running version 1"));
    const Outcome restart = attach("restart()");
    CHECK(restart.status == 1);
    CHECK_THAT(restart.error, Contains("there is no script 'it'") && Contains("it.lua is a FIFO, expected a file"));
    CHECK(attach("it.status").out == "\"ACTIVE\"\n");
    fs::remove(project.scratch.path("behaviors/it.lua"));
    project.scratch.write("behaviors/it.lua", "function on_execute() state.is_new = true end\n");
    CHECK(program.wait_for_error("version 2 runs in it"));
    CHECK(attach("it.state.is_new").out == "true\n");
    CHECK(attach("restart()").status == 0);
    project.make_fifo("behaviors/it.lua");
    program.send(SIGINT);
    const auto begin = std::chrono::steady_clock::now();
    CHECK(program.wait() == 0);
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(10));
    unsetenv("XDG_RUNTIME_DIR");
}
