// Commands from scripts: `nezumi run --batch` and `nezumi attach`.
#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

// A folder for sockets of this test's own, and a system.
struct Place {
    Place() {
        if (const char* given = std::getenv("XDG_RUNTIME_DIR")) before = given;
        std::filesystem::create_directory(scratch.path("runtime"));
        setenv("XDG_RUNTIME_DIR", scratch.path("runtime").c_str(), 1);
        scratch.write("behaviors/it.lua", R"(
param("speed_x", 0.1, { min = 0.0, max = 1.5 })
state.count = 0
function on_execute()
  state.count = state.count + 1
  if state.count % 5 == 0 then log.warn("five more") end
end
)");
        system = scratch.write("tiny.lua", "behavior \"it\" { script = \"it\" }\n").string();
    }
    ~Place() {
        if (before) {
            setenv("XDG_RUNTIME_DIR", before->c_str(), 1);
        } else {
            unsetenv("XDG_RUNTIME_DIR");
        }
    }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

    Outcome batch(const std::string& commands) const {
        return run_nezumi({"run", system, "--batch"}, "", scratch.write("commands", commands).string());
    }
    Scratch scratch;
    std::string system;
    std::optional<std::string> before;
};

// A system that runs until it is told to end.
struct Running : Place {
    Running() {
        for (int tries = 0; tries < 300 && run_nezumi({"attach", "--list"}).status != 0; ++tries) usleep(100'000);
    }
    Program program{{"run", system, "--headless"}};
};

}  // namespace

TEST_CASE("the option --eval shows all of a long output, also where it is read late", "[cli][attach]") {
    Running running;
    constexpr int lines = 100'000;
    Program eval({"attach", "--eval", "for i = 1, " + std::to_string(lines) + " do print(i) end"});
    usleep(500'000);
    CHECK(eval.wait() == 0);
    CHECK(eval.error.empty());
    CHECK(std::count(eval.out.begin(), eval.out.end(), '\n') == lines);
    running.program.send(SIGINT);
    CHECK(running.program.wait() == 0);
}

TEST_CASE("a run that is repeated is looked at and paced by attach, and is not changed", "[cli][attach][journal]") {
    const Place place;
    const std::string journal = place.scratch.path("run.journal").string();
    const Outcome first = run_nezumi(
        {"run", place.system, "--headless", "--speed", "max", "--duration", "3", "--trace-hash", "--journal", journal});
    REQUIRE(first.status == 0);
    Program again({"run", "--replay", journal, "--speed", "0.01", "--trace-hash"});
    for (int tries = 0; tries < 300 && run_nezumi({"attach", "--list"}).status != 0; ++tries) usleep(100'000);
    CHECK(run_nezumi({"attach", "--eval", "it.config.speed_x"}).out == "0.1\n");
    for (const char* const change : {"it.config.speed_x = 0.3", "restart()", "rewind(0)", "it:deactivate()"}) {
        const Outcome refused = run_nezumi({"attach", "--eval", change});
        INFO(change);
        CHECK(refused.status != 0);
        CHECK(refused.error.find("a run that is repeated can't be changed: nezumi open " + journal +
                                 " can go back in it and change it\n") != std::string::npos);
    }
    CHECK(run_nezumi({"attach", "--eval", "speed \"max\" resume()"}).status == 0);
    CHECK(again.wait() == 0);
    CHECK(again.out == first.out);
}

TEST_CASE("options of attach that do not go together are refused", "[cli][attach]") {
    const auto said = [](const std::vector<std::string>& words) {
        const Outcome outcome = run_nezumi(words);
        CHECK(outcome.status == 2);
        CHECK(outcome.out.empty());
        return outcome.error;
    };
    CHECK(said({"attach", "--list", "--eval", "1"}) == "nezumi: --list only lists running systems: leave out --eval\n");
    CHECK(said({"attach", "--list", "--timeout", "1"}) == "nezumi: --timeout works only with --eval\n");
    CHECK(said({"attach", "--ssh-config", "x", "--list"}) ==
          "nezumi: --ssh-config is for a system on another computer, as in ssh:pi@mouse\n");
}

TEST_CASE("the option --batch runs commands in order; time moves only by step and run", "[cli][batch]") {
    const Place place;
    const Outcome outcome = place.batch(
        "it.state.count\nstep(3)\nit.state.count\n\n-- nothing\nfor i = 1, 2 do\n  print(i)\nend\nrun(0.02)\n"
        "it.state.count\nit.config.speed_x = 0.5\nit.config.speed_x");
    CHECK(outcome.out == "0\n3\n1\n2\n5\n0.5\n");
    CHECK(outcome.error == "[    0.040] warn  it: five more\n");
    CHECK(outcome.status == 0);
}

TEST_CASE("an error in --batch ends its command only, is reported with its line, and sets the exit status",
          "[cli][batch]") {
    const Place place;
    const Outcome outcome = place.batch("1\nx = = 1\n2\nfunction f()\n  error 'no'\nend\nf()\nit.cofig\n3\nx = {");
    CHECK(outcome.out == "1\n2\n3\n");
    CHECK(outcome.error ==
          "line 2: unexpected symbol near '='\nline 7: no\nline 8: it has no 'cofig' (did you mean 'config'?)\n"
          "line 10: unexpected symbol near <eof>\n");
    CHECK(outcome.status == 1);
}

TEST_CASE("the option --batch says the same each time, also with much output", "[cli][batch]") {
    const Place place;
    const std::string commands =
        "for i = 1, 20000 do print(i, ('x'):rep(100)) end\nrun(2)\nit.state.count\nquit()\n'not'\n";
    const Outcome one = place.batch(commands);
    const Outcome other = place.batch(commands);
    CHECK(one.status == 0);
    CHECK(one.out.size() > 2'000'000);
    CHECK(one.out.ends_with("\n200\n"));
    CHECK(one.out == other.out);
    CHECK(one.error == other.error);
}

TEST_CASE("a watch in --batch leaves no change out", "[cli][batch]") {
    const Place place;
    place.scratch.write("behaviors/it.lua", R"(
local count = output("count", "TimedLong")
state.count = 0
function on_execute()
  state.count = state.count + 1
  count:write(state.count)
end
)");
    const Outcome outcome = place.batch("watch(it.count)\nstep(2)\nstep(1)");
    CHECK(outcome.out == "[0.000] it.count = 1\n[0.010] it.count = 2\n[0.020] it.count = 3\n");
    CHECK(outcome.error.empty());
}

TEST_CASE("attach --eval prints what a text gives, and its exit status says how it went", "[cli][attach]") {
    const Running running;
    const Outcome value = run_nezumi({"attach", "--eval", "1 + 1"});
    CHECK(value.out == "2\n");
    CHECK(value.error.empty());
    CHECK(value.status == 0);
    const Outcome wrong = run_nezumi({"attach", "tiny", "--eval", "it.config.speed_x = 9"});
    CHECK(wrong.out.empty());
    CHECK(wrong.error == "parameter 'speed_x' (number): 9.0 is above its maximum 1.5\n");
    CHECK(wrong.status == 1);
    CHECK(run_nezumi({"attach", "--eval", "drive 'it'"}).status == 1);
    const std::string commands = running.scratch.write("commands", "1\nnone\n2\n").string();
    const Outcome piped = run_nezumi({"attach"}, "", commands);
    CHECK(piped.out == "1\n2\n");
    CHECK(piped.status == 1);
}

TEST_CASE("attach says what runs when it can't find its system", "[cli][attach]") {
    {
        const Place place;
        for (const std::vector<std::string>& words : {std::vector<std::string>{"attach"}, {"attach", "--list"}}) {
            const Outcome outcome = run_nezumi(words);
            CHECK(outcome.error == "nezumi: nothing is running: start a system with `nezumi run FILE`\n");
            CHECK(outcome.status == 2);
        }
    }
    const Running running;
    const Outcome slip = run_nezumi({"attach", "tinny", "--eval", "1"});
    CHECK_THAT(slip.error,
               Catch::StartsWith("nezumi: no system 'tinny' is running (did you mean 'tiny'?); running: tiny "));
    CHECK(slip.status == 2);
}

TEST_CASE("a system that is stopped does not block access to others, and blocks no client for ever", "[cli][attach]") {
    Running running;
    const std::string other = running.scratch.write("other.lua", "behavior \"it\" { script = \"it\" }\n").string();
    Program second({"run", other, "--headless"});
    for (int tries = 0; tries < 300 && run_nezumi({"attach", "other", "--eval", "1"}).status != 0; ++tries)
        usleep(100'000);
    running.program.send(SIGSTOP);
    // More than may wait at its door.
    for (int i = 0; i < 20; ++i) {
        const Outcome list = run_nezumi({"attach", "--list"});
        CHECK(list.status == 0);
        CHECK_THAT(list.out, Catch::Contains(" other\n") && Catch::Contains(" tiny\n"));
    }
    CHECK(run_nezumi({"attach", "other", "--eval", "1 + 1"}).out == "2\n");
    const auto begin = std::chrono::steady_clock::now();
    const Outcome full = run_nezumi({"attach", "tiny", "--eval", "1"});
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(20));
    CHECK(full.status == 2);
    CHECK_THAT(full.error,
               Catch::Matches("nezumi: tiny \\(process [0-9]+\\) does not answer: it is stopped, or very busy\n"));
    running.program.send(SIGCONT);
    CHECK(run_nezumi({"attach", "tiny", "--eval", "1 + 1"}).out == "2\n");
    running.program.send(SIGSTOP);  // lets in, and does not answer
    CHECK(run_nezumi({"attach", "tiny", "--eval", "1"}).error == full.error);
    running.program.send(SIGCONT);
}

TEST_CASE("attach --eval --timeout interrupts a text that takes longer", "[cli][attach]") {
    const Running running;
    const Outcome late = run_nezumi({"attach", "--timeout", "0.3", "--eval", "print 'begins' run(1000)"});
    CHECK(late.status == 1);
    CHECK(late.out == "begins\n");
    CHECK(late.error == "no answer within 0.3 s: interrupted\n");
    CHECK(run_nezumi({"attach", "--timeout", "20", "--eval", "1 + 1"}).out == "2\n");
    CHECK(run_nezumi({"attach", "--timeout", "20"}).error == "nezumi: --timeout works only with --eval\n");
    CHECK(run_nezumi({"attach", "--timeout", "0", "--eval", "1"}).status == 2);
}

TEST_CASE("quit by attach ends a run in good order", "[cli][attach]") {
    Running running;
    CHECK(run_nezumi({"attach", "--eval", "quit()"}).status == 0);
    CHECK(running.program.wait() == 0);
    CHECK(run_nezumi({"attach", "--eval", "1"}).status == 2);
}

TEST_CASE("another user does not get in", "[cli][attach]") {
    Running running;
    const auto mode = std::filesystem::status(running.scratch.path("runtime/nezumi")).permissions();
    CHECK(mode == std::filesystem::perms(0700));
    if (geteuid() != 0) return;  // only root can be somebody else
    std::filesystem::permissions(running.scratch.path(""), std::filesystem::perms(0755));
    std::filesystem::permissions(running.scratch.path("runtime"), std::filesystem::perms(0755));
    REQUIRE(seteuid(65534) == 0);
    std::error_code error;
    const std::filesystem::directory_iterator files(running.scratch.path("runtime/nezumi"), error);
    REQUIRE(seteuid(0) == 0);
    CHECK(error == std::errc::permission_denied);
}

TEST_CASE("a plot shows the time before anybody attached", "[cli][attach]") {
    const Place place;
    place.scratch.write("behaviors/it.lua", R"(
local out = output("out", "TimedDouble", "a number that grows")
function on_execute() out:write(now()) end
)");
    const Program program({"run", place.system, "--headless"});
    const auto attach = [](const std::string& text) { return run_nezumi({"attach", "--eval", text}); };
    for (int tries = 0; tries < 300 && attach("step(100)").status != 0; ++tries) usleep(100'000);
    const Outcome plot = attach("plot(it.out, 5)");
    CHECK(plot.status == 0);
    CHECK_THAT(plot.out, Catch::StartsWith("it.out\nvalue\n") && Catch::Contains("0 │⣀"));
}
