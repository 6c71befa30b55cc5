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

const std::string stop_at_wall = "behaviors/systems/stop_at_wall.lua";

}  // namespace

TEST_CASE("equal seeds give equal trace hashes, whatever the speed and the threads", "[cli][run]") {
    std::set<std::string> hashes;
    const std::vector<std::vector<std::string>> ways{{"--headless", "--speed", "max"},
                                                     {"--headless", "--speed", "max", "--threads", "3"},
                                                     {"--headless", "--speed", "20"},
                                                     {"--speed", "20"},
                                                     {"--speed", "max"}};
    for (auto way : ways) {
        way.insert(way.begin(), {"run", stop_at_wall, "--duration", "4", "--seed", "1", "--trace-hash"});
        const Outcome outcome = run_nezumi(way);
        REQUIRE(outcome.status == 0);
        hashes.insert(outcome.out);
    }
    CHECK(hashes.size() == 1);
    const std::string line = *hashes.begin();
    REQUIRE(line.size() == 29);
    CHECK(line.substr(0, 12) == "trace hash: ");
    CHECK(line.substr(12, 16).find_first_not_of("0123456789abcdef") == std::string::npos);
    CHECK(line.back() == '\n');
}

TEST_CASE("the option --seed wins over the file's seed", "[cli][run]") {
    const BehaviorProject project(R"(local out = output("out", "TimedDouble", "a number")
function on_execute() out:write(math.random()) end
)",
                                  "seed(7)\nbehavior \"it\" { script = \"it\" }\n");
    const auto hash = [&](std::vector<std::string> options) {
        options.insert(options.end(), {"--duration", "0.1", "--trace-hash"});
        return project.run(options).out;
    };
    CHECK(hash({}) == hash({"--seed", "7"}));
    CHECK(hash({}) != hash({"--seed", "8"}));
    CHECK(hash({"--seed", "8"}) == hash({"--seed", "8"}));
}

TEST_CASE("the option --record writes a row for every tick of the duration, and a column for every element",
          "[cli][run]") {
    const Scratch scratch;
    const std::string file = scratch.path("trace.csv").string();
    REQUIRE(run_nezumi({"run", stop_at_wall, "--headless", "--speed", "max", "--duration", "2", "--record", file,
                        "--ports", "mouse.ir_sensor_out,controller.out,controller.in"})
                .status == 0);
    const auto lines = lines_of(text_of_file(file));
    REQUIRE(lines.size() == 201);
    CHECK(lines[0] ==
          "time,mouse.ir_sensor_out[1],mouse.ir_sensor_out[2],mouse.ir_sensor_out[3],mouse.ir_sensor_out[4],"
          "controller.out.vx,controller.out.vy,controller.out.va,"
          "controller.in[1],controller.in[2],controller.in[3],controller.in[4]");
    CHECK(lines[1] == "0,0,0,0,0,0.1,0,0,0,0,0,0");
    CHECK(lines[200].substr(0, 5) == "1.99,");
}

TEST_CASE("a sequence that grows gets columns, and earlier rows empty cells", "[cli][run]") {
    const BehaviorProject project(R"(local words = output("words", "TimedStringSeq", "texts")
local count = output("count", "TimedShort", "how many")
function on_execute()
  local tick = math.floor(now() * 100 + 0.5)
  if tick == 0 then return end
  local list = {}
  for i = 1, tick do list[i] = 'say "' .. i .. '",\n' end
  words:write(list)
  count:write(tick)
end
)");
    const std::string file = project.scratch.path("trace.csv").string();
    REQUIRE(project.run({"--duration", "0.03", "--record", file}).status == 0);
    CHECK(text_of_file(file) ==
          "time,it.words[1],it.words[2],it.count\n"
          "0,,,\n"
          "0.01,\"say \"\"1\"\",\n\",,1\n"
          "0.02,\"say \"\"1\"\",\n\",\"say \"\"2\"\",\n\",2\n");
    CHECK_FALSE(std::filesystem::exists(file + ".part"));
}

TEST_CASE("a recording has each of several messages of one tick, in rows of the same time", "[cli][run]") {
    const BehaviorProject project(R"(local out = output("out", "TimedLong", "a number")
local half = output("half", "TimedDouble", "another one")
function on_execute()
  local tick = math.floor(now() * 100 + 0.5)
  for i = 1, tick do out:write(10 * tick + i) end
  half:write(tick / 2)
end
)");
    const std::string file = project.scratch.path("trace.csv").string();
    REQUIRE(project.run({"--duration", "0.04", "--record", file}).status == 0);
    CHECK(text_of_file(file) ==
          "time,it.out,it.half\n0,,0\n0.01,11,0.5\n0.02,21,1\n0.02,22,1\n0.03,31,1.5\n0.03,32,1.5\n0.03,33,1.5\n");
}

TEST_CASE("the option --ports takes truth, parameters and state as a console names them", "[cli][run]") {
    const BehaviorProject project(R"(local speed = output("speed", "TimedVelocity2D", "how fast")
param("vx", 0.25, { max = 1.0 })
state.count = 0
state.seen = { near = false }
function on_execute()
  state.count = state.count + 1
  if state.count == 2 then config.vx = 0.5 end
  speed:write { vx = config.vx }
end
)",
                                  "robot \"mouse\" { model = \"raspimouse\", pose = { x = 1, y = 0, heading = 0 } }\n"
                                  "behavior \"it\" { script = \"it\" }\n"
                                  "connect(\"it.speed\", \"mouse.target_velocity_in\")\n");
    const std::string file = project.scratch.path("trace.csv").string();
    const auto recorded = [&](const std::string& names) {
        REQUIRE(project.run({"--duration", "0.03", "--record", file, "--ports", names}).status == 0);
        return text_of_file(file);
    };
    CHECK(recorded("it.state.count,it.config.vx,it.speed.vx,it.state.seen") ==
          "time,it.state.count,it.config.vx,it.speed.vx,it.state.seen.near\n"
          "0,1,0.25,0.25,0\n0.01,2,0.25,0.25,0\n0.02,3,0.5,0.5,0\n");
    const auto lines = lines_of(recorded("mouse.truth"));
    REQUIRE(lines.size() == 4);
    CHECK(
        lines[0] ==
        "time,mouse.truth.pose.position.x,mouse.truth.pose.position.y,mouse.truth.pose.heading,mouse.truth.velocity.vx,"
        "mouse.truth.velocity.vy,mouse.truth.velocity.va,mouse.truth.height,mouse.truth.tilt");
    // As its sensors saw it in this tick: before the first one nothing has moved.
    CHECK(lines[1].substr(0, 9) == "0,1,0,0,0");
    CHECK(recorded("mouse.truth.pose.position").substr(0, 65) ==
          "time,mouse.truth.pose.position.x,mouse.truth.pose.position.y\n0,1,");
    const Outcome refused = project.run({"--record", file, "--ports", "it.truth"});
    CHECK(refused.status == 2);
    CHECK(refused.error == "nezumi: --ports: it has no truth: it is no robot\n");
}

TEST_CASE("the same simulated time gives the same files and hash, whether --duration or commands say it",
          "[cli][run]") {
    const Scratch scratch;
    const auto results = [&](const std::string& name, const std::vector<std::string>& how, const std::string& input) {
        const std::string csv = scratch.path(name + ".csv").string(), png = scratch.path(name + ".png").string();
        std::vector<std::string> words{"run", stop_at_wall, "--trace-hash", "--record", csv, "--picture", png};
        words.insert(words.end(), how.begin(), how.end());
        const Outcome outcome = run_nezumi(words, "", scratch.write("commands", input).string());
        REQUIRE(outcome.status == 0);
        return std::vector<std::string>{outcome.out, text_of_file(csv), text_of_file(png)};
    };
    const auto said = results("said", {"--headless", "--speed", "max", "--duration", "3"}, "");
    CHECK(lines_of(said[1]).size() == 301);
    const auto compare = [&](const std::vector<std::string>& other) {
        for (std::size_t i = 0; i < said.size(); ++i) CHECK((said[i] == other[i]));
    };
    compare(results("run", {"--batch"}, "run(3)\n"));
    compare(results("step", {"--batch"}, "step(120)\nrun(1.8)\nquit()\n"));
}

TEST_CASE("a disk that is full ends the run with one line", "[cli][run]") {
    const Outcome outcome =
        run_nezumi({"run", stop_at_wall, "--headless", "--speed", "max", "--duration", "100", "--record", "/dev/full"});
    CHECK(outcome.status == 2);
    CHECK(outcome.error == "/dev/full: can't be written: No space left on device\n");
}

TEST_CASE("the option --picture draws PNG or SVG by the file's ending", "[cli][run]") {
    const Scratch scratch;
    const std::string png = scratch.path("a.png").string(), svg = scratch.path("a.svg").string();
    for (const std::string& file : {png, svg}) {
        REQUIRE(run_nezumi({"run", stop_at_wall, "--headless", "--speed", "max", "--duration", "5", "--picture", file})
                    .status == 0);
    }
    CHECK(text_of_file(png).substr(0, 8) == "\x89PNG\r\n\x1a\n");
    CHECK(text_of_file(svg).find("<svg ") != std::string::npos);
    CHECK(text_of_file(svg).find("</svg>") != std::string::npos);
}

TEST_CASE("commands that are cut off cost the exit status", "[cli][run]") {
    const Scratch files;
    files.write("commands", "print('begins')\nrun(1e8)\n");
    Program program({"run", "behaviors/systems/stop_at_wall.lua", "--batch"}, "", files.path("commands").string());
    REQUIRE(program.wait_for_output("begins"));
    program.send(SIGINT);
    CHECK(program.wait() == 1);
    CHECK(program.error.find("line 2: not run to its end: a signal ended the run\n") != std::string::npos);
}

TEST_CASE("a batch whose time is over before its commands says which line was not run, and ends with 1", "[cli][run]") {
    const Scratch files;
    const auto run = [&](const std::string& commands) {
        files.write("commands", commands);
        return run_nezumi({"run", stop_at_wall, "--batch", "--duration", "1"}, "", files.path("commands").string());
    };
    const Outcome cut = run("run(0.5)\nprint('b')\nrun(5)\nnope\n");
    CHECK(cut.status == 1);
    CHECK(cut.out == "b\n");
    CHECK(cut.error == "line 3: not run to its end: --duration ended the run at 1 s\n");

    const Outcome never = run("run(1) print('all of the line')\n\n\nprint('never')\n");
    CHECK(never.status == 1);
    CHECK(never.out == "all of the line\n");
    CHECK(never.error == "line 4: not run to its end: --duration ended the run at 1 s\n");

    for (const char* whole : {"run(1)\n", "run(1) print(1)\n \n", "run(0.5)\nquit()\nrun(9)\n"}) {
        const Outcome outcome = run(whole);
        INFO(whole << outcome.error);
        CHECK(outcome.status == 0);
        CHECK(outcome.error.empty());
    }
}

TEST_CASE("a signal ends a run in good order: robots stopped, files complete, status 0", "[cli][run]") {
    const Scratch scratch;
    const std::string csv = scratch.path("trace.csv").string(), png = scratch.path("end.png").string();
    const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP);
    Program program({"run", stop_at_wall, "--headless", "--trace-hash", "--record", csv, "--picture", png, "--ports",
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

TEST_CASE(
    "a script that reaches its budget ends a headless run; of its files the rows that are whole stay, with a note",
    "[cli][run]") {
    const BehaviorProject project(
        "local out = output('out', 'TimedDouble', 'a number')\n"
        "function on_execute()\n  out:write(1)\n  while now() > 0.05 do end\nend\n");
    const std::string csv = project.scratch.path("trace.csv").string(), png = project.scratch.path("end.png").string();
    const Outcome outcome = project.run({"--duration", "1", "--trace-hash", "--record", csv, "--picture", png});
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.error.find("it.lua:4: ") != std::string::npos);
    const auto rows = lines_of(text_of_file(csv));
    REQUIRE(rows.size() > 5);
    CHECK(rows[0] == "time,it.out");
    CHECK(rows[1] == "0,1");
    CHECK(rows[rows.size() - 2].ends_with(",1"));
    CHECK(rows.back().starts_with("# the recording ends here: "));
    CHECK(rows.back().find("it.lua:4: ") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(png));
}

TEST_CASE("a behaviour that reaches its budget while the run ends, or on the way to ERROR, makes it none",
          "[cli][run][watchdog]") {
    for (const char* text : {"function on_execute() end\nfunction on_deactivated() while true do end end\n",
                             "function on_execute() error('x') end\nfunction on_aborting() while true do end end\n"}) {
        const Outcome outcome = BehaviorProject(text).run({"--duration", "0.05", "--trace-hash"});
        CHECK(outcome.status == 2);
        CHECK(outcome.out.empty());
        CHECK(outcome.error.find("it.lua:2: ran for more than 2 s") != std::string::npos);
    }
}

TEST_CASE("a component in ERROR at the end is said, and makes the status 1", "[cli][run]") {
    const BehaviorProject project("param('x', 1)\nfunction on_execute() error('no way') end\n");
    const Outcome outcome = project.run({"--duration", "1", "--trace-hash"});
    CHECK(outcome.status == 1);
    CHECK(outcome.out.substr(0, 12) == "trace hash: ");
    CHECK(outcome.error.find("nezumi: it ended in ERROR: ") != std::string::npos);
    CHECK(outcome.error.find("it.lua:2: no way") != std::string::npos);
}

TEST_CASE("probes and what is printed never change the trace hash", "[cli][run]") {
    const auto hash = [](const std::string& more) {
        const BehaviorProject project(
            "local out = output('out', 'TimedDouble')\nfunction on_execute()\n  out:write(now()) " + more + "\nend\n");
        return project.run({"--duration", "0.2", "--trace-hash"}).out;
    };
    const std::string plain = hash("");
    CHECK(plain.substr(0, 12) == "trace hash: ");
    CHECK(hash("probe('x', now()) probe('y', { now() }) print({ now() })") == plain);
}

TEST_CASE("probes are recorded where that is asked for", "[cli][run]") {
    const BehaviorProject project("function on_execute()\n  probe('x', now()) probe('y', { left = true })\nend\n");
    const std::string csv = project.scratch.path("probes.csv").string();
    const Outcome outcome = project.run({"--duration", "0.02", "--record", csv, "--ports", "it.probes"});
    CHECK(outcome.status == 0);
    const std::string text = text_of_file(csv);
    CHECK_THAT(text, Catch::StartsWith("time,it.probes.x,it.probes.y.left\n"));
    CHECK_THAT(text, Catch::Contains("\n0.01,0.01,1\n"));
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

TEST_CASE("the options --set and --params give parameters their values, also after a restart and in a replay",
          "[cli][run]") {
    const BehaviorProject project(R"(param("speed", 0.1)
local out = output("out", "TimedDouble", "a number")
function on_execute() out:write(config.speed) end
)");
    const auto hash = [&](std::vector<std::string> options) {
        options.insert(options.end(), {"--duration", "0.1", "--trace-hash"});
        const Outcome outcome = project.run(options);
        CAPTURE(outcome.error);
        CHECK(outcome.status == 0);
        return outcome.out;
    };
    const std::string saved =
        project.scratch.write("saved.lua", "behavior \"it\" { script = \"it\", config = { speed = 0.5 } }\n").string();
    const std::string half = hash({"--set", "it.speed=0.5"});
    CHECK(half != hash({}));
    CHECK(hash({"--params", saved}) == half);
    CHECK(hash({"--params", saved, "--set", "it.speed=0.1"}) == hash({}));

    const std::string commands = project.scratch.write("commands", "run(0.1)\nrestart()\nit.config.speed\n").string();
    CHECK(run_nezumi({"run", project.file, "--batch", "--set", "it.speed=0.5"}, "", commands).out.find("0.5") !=
          std::string::npos);

    const std::string journal = project.scratch.path("journal").string();
    CHECK(hash({"--set", "it.speed=0.5", "--journal", journal}) == half);
    const Outcome again = run_nezumi({"run", project.file, "--replay", journal, "--trace-hash"});
    CHECK(again.status == 0);
    CHECK(again.out == half);
}
