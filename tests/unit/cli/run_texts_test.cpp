// Text of a script, an error or a folder can't damage the output of `nezumi run`.
#include <catch2/catch.hpp>

#include <string>

#include "tests/unit/cli/behavior_project.hpp"

using namespace nezumi;

TEST_CASE("an error of several lines forges no line of the log, at the end either", "[cli][run]") {
    const BehaviorProject project("function on_execute() error('a\\n[    9.000] info  it: all is well') end\n");
    const Outcome outcome = project.run({"--duration", "0.05"});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.error, Catch::Contains("it.lua:1: a\n            | [    9.000] info  it: all is well\n"));
    CHECK(outcome.error.find("\n[    9.000] info") == std::string::npos);
}

TEST_CASE("the output of a script can't control the terminal", "[cli][run]") {
    const BehaviorProject project("function on_activated() print('\\27[2Jgone\\0\\200') end\n");
    const Outcome run = run_nezumi({"run", project.file, "--headless", "--speed", "max", "--duration", "0.1"});
    CHECK(run.status == 0);
    CHECK_THAT(run.error, Catch::Contains("it: \\x1b[2Jgone\\x00"));
}

TEST_CASE("the output of a script can't look like a line of the log", "[cli][run]") {
    const BehaviorProject project("function on_activated() print('well\\n[    0.010] error mouse: burns') end\n");
    const Outcome run = run_nezumi({"run", project.file, "--headless", "--speed", "max", "--duration", "0.1"});
    CHECK_THAT(run.error, Catch::Contains("it: well\n"));
    CHECK_THAT(run.error, Catch::Contains("| [    0.010] error mouse: burns\n") &&
                              !Catch::Contains("\n[    0.010] error mouse: burns"));
}

TEST_CASE("a folder's name can't reverse the direction of an error's text", "[cli][run]") {
    const std::string turned =
        "systems\xE2\x80\xAE"
        "aul.";
    const Scratch scratch;
    scratch.write(turned + "/s.lua", "robot(");
    const Outcome run = run_nezumi({"run", scratch.path(turned + "/s.lua").string(), "--headless"});
    CHECK(run.status == 2);
    CHECK_THAT(run.error, Catch::Contains("systems\\u202eaul./s.lua:1") && !Catch::Contains("\xE2\x80\xAE"));
}
