// What `nezumi run` can't do: one plain line, exit status 2, nothing half done.
#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

/// Runs a system in a project that has one behaviour, with a picture and a record asked for, in its folder. The run
/// must be refused and leave nothing behind. Returns its one line.
std::string refused(const std::string& system, std::vector<std::string> options = {}) {
    const Scratch scratch;
    scratch.write("behaviors/it.lua",
                  "param('speed', 0.1, { min = 0, max = 1 })\n"
                  "local out = output('out', 'TimedVelocity2D', 'velocity')\n"
                  "function on_execute() out:write { vx = config.speed } end\n");
    scratch.write("behaviors/broken.lua", "param('x', 1)\nfunction on_execute( end\n");
    scratch.write("behaviors/odd.lua", "local port = input('in', 'TimedShor', 'a number')\n");
    scratch.write("map.csv", "x,y,z,lx,ly,lz,yaw\n1,0,0.1,0.1,1,wide,0\n");
    scratch.write("system.lua", system);
    options.insert(options.begin(), {"run", "system.lua", "--headless", "--speed", "max", "--duration", "0.1"});
    if (std::find(options.begin(), options.end(), "--picture") == options.end())
        options.insert(options.end(), {"--picture", "end.png"});
    if (std::find(options.begin(), options.end(), "--record") == options.end())
        options.insert(options.end(), {"--record", "trace.csv"});
    const Outcome outcome = run_nezumi(options, scratch.path("").string());
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK_FALSE(std::filesystem::exists(scratch.path("end.png")));
    CHECK_FALSE(std::filesystem::exists(scratch.path("trace.csv")));
    CHECK(std::count(outcome.error.begin(), outcome.error.end(), '\n') == 1);
    return outcome.error.substr(0, outcome.error.find('\n'));
}

const std::string good = "behavior \"it\" { script = \"it\" }\n";
const std::string mouse = "robot \"mouse\" { model = \"raspimouse\" }\n";

}  // namespace

TEST_CASE("what is wrong with a system is said with its place", "[cli][run][watchdog]") {
    CHECK(refused("behavior \"it\" { script = \"itt\" }\n").find("system.lua:1:") == 0);
    CHECK(refused("behavior \"it\" { script = \"itt\" }\n").find("did you mean 'it'") != std::string::npos);
    CHECK(refused("behavior \"it\" { script = \"broken\" }\n").find("behaviors/broken.lua:2: ") == 0);
    CHECK(refused("behavior \"it\" { script = \"odd\" }\n").find("behaviors/odd.lua:1: ") == 0);
    CHECK(refused("behavior \"it\" { script = \"odd\" }\n").find("did you mean 'TimedShort'") != std::string::npos);
    CHECK(refused("robot \"m\" { model = \"raspimose\" }\n").find("did you mean 'raspimouse'") != std::string::npos);
    CHECK(refused(mouse + good + "\nconnect(\"it.out\", \"mouse.target_velocity\")\n") ==
          "system.lua:4: mouse has no in-port 'target_velocity' (did you mean 'target_velocity_in'?)");
    CHECK(refused("behavior \"it\" { script = \"it\", config = { sped = 1 } }\n").find("did you mean 'speed'") !=
          std::string::npos);
    CHECK(refused("behavior \"it\" { script = \"it\", config = { speed = 2 } }\n").find("system.lua:1:") == 0);
    CHECK(refused("arena { csv \"map.csv\" }\n").find("map.csv:2:") == 0);
    CHECK(refused("arena { csv \"map.csv\" }\n").find("'lz'") != std::string::npos);
    CHECK(refused("robot \"mouse\" {\n").find("system.lua:") == 0);
    CHECK(refused("while true do end\n").find("system.lua:1:") == 0);
}

TEST_CASE("a file that can't be read is said", "[cli][run]") {
    const Scratch scratch;
    const std::string none = scratch.path("none.lua").string(), folder = scratch.path("").string();
    const Outcome missing = run_nezumi({"run", none});
    CHECK(missing.status == 2);
    CHECK(missing.error == none + ": there is no such file\n");
    const Outcome is_folder = run_nezumi({"run", folder});
    CHECK(is_folder.status == 2);
    CHECK(is_folder.error.find("folder") != std::string::npos);
}

TEST_CASE("what is wrong with an option is said", "[cli][run]") {
    CHECK(refused(good, {"--speed", "fast"}).find("more than once") != std::string::npos);
    CHECK(refused(good, {"--picture", "x.gif"}) ==
          "nezumi: --picture: expected a file name that ends in .png or .svg, got 'x.gif'");
    CHECK(refused(good, {"--picture", "none/x.png"}) == "none/x.png: can't be written: No such file or directory");
    CHECK(refused(good, {"--record", "none/x.csv"}) == "none/x.csv: can't be written: No such file or directory");
    CHECK(refused(good, {"--record", "behaviors"}) == "behaviors: can't be written: Is a directory");
    CHECK(refused(good, {"--seed", "-1"}) == "nezumi: --seed: expected a whole number from 0 to 2^64 - 1, got '-1'");
    CHECK(refused(good, {"--threads", "0"}) == "nezumi: --threads: expected a whole number from 1 to 256, got '0'");
    CHECK(refused(good, {"--ports", "it.outt"}) == "nezumi: --ports: it has no port 'outt' (did you mean 'out'?)");
    CHECK(refused(good, {"--ports", "itt.out"}) ==
          "nezumi: --ports: 'itt.out': there is no component 'itt' (did you mean 'it'?)");
    CHECK(refused(good, {"--ports", "it.out,,"}) ==
          "nezumi: --ports: expected names of ports as in mouse.ir_sensor_out,controller.out, got 'it.out,,'");
    CHECK(refused(good, {"--durations", "3"}) ==
          "nezumi: there is no option '--durations' (did you mean '--duration'?); see nezumi run --help");
    CHECK(refused(good, {"more"}) == "nezumi: 'more' is one word too many; see nezumi run --help");

    const auto said = [](std::vector<std::string> words) {
        const Outcome outcome = run_nezumi(std::move(words));
        CHECK(outcome.status == 2);
        return outcome.error;
    };
    CHECK(said({"run", "x.lua", "--speed", "fast"}) ==
          "nezumi: --speed: expected a factor from 0.001 to 1000000, or max, got 'fast'\n");
    CHECK(said({"run", "x.lua", "--speed", "-1"}) ==
          "nezumi: --speed: expected a factor from 0.001 to 1000000, or max, got '-1'\n");
    CHECK(said({"run", "x.lua", "--duration", "-1"}) ==
          "nezumi: --duration: expected seconds from 0 to 1000000000, got '-1'\n");
    CHECK(said({"run", "x.lua", "--duration", "nan"}) ==
          "nezumi: --duration: expected seconds from 0 to 1000000000, got 'nan'\n");
    CHECK(said({"run", "x.lua", "--duration", "1e300"}) ==
          "nezumi: --duration: expected seconds from 0 to 1000000000, got '1e300'\n");
    CHECK(said({"run", "x.lua", "--open", "--headless"}) ==
          "nezumi: --open: a run for machines serves no page: leave it out\n");
    CHECK(said({"run", "x.lua", "--open", "--no-web"}) ==
          "nezumi: --open: --no-web serves no page: leave out one of them\n");
    CHECK(said({"check", "x.lua", "--name", "y.lua"}) ==
          "nezumi: check: --name is for what comes from standard input: give - as the file\n");
    CHECK(said({"run", "x.lua", "--ports", "a.b"}) ==
          "nezumi: --ports chooses what --record writes: give --record FILE.csv as well\n");
    for (const char* option : {"--speed", "--duration", "--seed", "--threads", "--picture", "--record", "--sounds"}) {
        CHECK(said({"run", "x.lua", option, ""}) ==
              "nezumi: " + std::string(option) + ": expected a value, got ''; see nezumi run --help\n");
    }
    CHECK(said({"test", "--jobs", "0"}) ==
          "nezumi: --jobs: expected a whole number from 1 to 1024, got '0'; see nezumi test --help\n");
    CHECK(said({"test", "--repeat", "x"}) ==
          "nezumi: --repeat: expected a whole number from 1 to 1000000, got 'x'; see nezumi test --help\n");
    CHECK(said({"test", "--seed", "18446744073709551616"}) ==
          "nezumi: --seed: expected a whole number from 0 to 2^64 - 1, got '18446744073709551616'; see nezumi test "
          "--help\n");
    CHECK(said({"test", "-o", ""}) == "nezumi: --output: expected a value, got ''; see nezumi test --help\n");
    CHECK(said({"test", "--junit", ""}) == "nezumi: --junit: expected a value, got ''; see nezumi test --help\n");
    CHECK(said({"run", "behaviors/robot_controller.lua"}) ==
          "behaviors/robot_controller.lua:3:16: unknown global 'input': it is a behaviour's; a system file says "
          "`behavior NAME { script = ... }`\n");
    CHECK(said({"run", "tests/scenarios/golden_test.lua"}).find("a scenario's; try `nezumi test`\n") !=
          std::string::npos);
    CHECK(said({"run", "engine/robots/ev3.lua"}).find("a robot's; a system file says `robot NAME { model = ... }`\n") !=
          std::string::npos);
    CHECK(said({"run"}) == "nezumi: FILE is missing; see nezumi run --help\n");
    CHECK(said({"run", "x.lua", "--speed"}) == "nezumi: --speed: a value is missing; see nezumi run --help\n");
    CHECK(said({"rum", "x.lua"}).find("there is no command 'rum' (did you mean 'run'?)") != std::string::npos);
}

TEST_CASE("a pipe that nobody reads is refused as a file for results, and one that is read is written", "[cli][run]") {
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
        CHECK(outcome.error == file + ": is a pipe that nobody reads: start its reader first, or give a file\n");
    }
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    REQUIRE(reader >= 0);
    CHECK(run("--journal", pipe).status == 0);
    char first = 0;
    CHECK(read(reader, &first, 1) == 1);
    CHECK(first == '{');
    close(reader);
}

TEST_CASE("tests in a folder that has been deleted are refused in plain words", "[cli][test]") {
    const Scratch scratch;
    const std::string gone = scratch.path("gone").string();
    std::filesystem::create_directory(gone);
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(gone);
    std::filesystem::remove(gone);
    const Outcome outcome = run_nezumi({"test"});
    std::filesystem::current_path(before);
    CHECK(outcome.status == 2);
    CHECK(outcome.error ==
          "nezumi: test: the folder that this is run in has been deleted: change to one that is there\n");
}

TEST_CASE("a value that --set or --params can't give is refused with the option or the line", "[cli][run]") {
    CHECK(refused(good, {"--set", "it.speed"}) ==
          "--set it.speed: expected COMPONENT.PARAMETER=VALUE as in controller.speed_x=0.3");
    CHECK(refused(good, {"--set", "ti.speed=1"}) ==
          "--set ti.speed=1: system.lua has no component 'ti' (did you mean 'it'?)");
    CHECK(refused(mouse + good, {"--set", "mous.speed=1"}) ==
          "--set mous.speed=1: system.lua has no component 'mous' (those with parameters are it)");
    CHECK(refused(good, {"--set", "it.sped=1"}) ==
          "--set it.sped=1: it: config: unknown parameter 'sped' (did you mean 'speed'?)");
    CHECK(refused(good, {"--set", "it.speed=2"})
              .starts_with("--set it.speed=2: it: config: parameter 'speed' (number): "));
    CHECK(refused(good, {"--set", "it.speed=fast"})
              .starts_with("--set it.speed=fast: it: config: parameter 'speed' (number): "));
    CHECK(refused(good, {"--set", "it.speed={ 1, print }"}).starts_with("--set it.speed={ 1, print }: "));
    CHECK(refused(mouse + good, {"--set", "mouse.speed=1"}) ==
          "--set mouse.speed=1: mouse: this robot has no parameters");
    CHECK(refused(good, {"--params", "none.lua"}) == "none.lua: there is no such file");
    for (const std::string option : {"--set", "--params"}) {
        const Outcome both = run_nezumi({"run", "it.lua", "--replay", "it.journal", option, "it.speed=1"});
        CHECK(both.status == 2);
        CHECK(both.error == "nezumi: --replay does what the journal says: leave out " + option + "\n");
    }
}
