// Files by their names, as run, check and test take them, and what is said where there is none.
#include <catch2/catch.hpp>

#include <string>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

// A project with one of each kind.
struct SmallProject {
    SmallProject() {
        files.write("behaviors/corridor.lua", "function on_execute() end\n");
        files.write("behaviors/systems/corridor.lua", "behavior 'it' { script = 'corridor' }\n");
        files.write("tests/corridor_test.lua", "scenario('runs', function(s) s:load 'corridor' s:run(0.1) end)\n");
        files.write("tests/deep/other_test.lua", "scenario('idles', function(s) s:load 'corridor' s:run(0.1) end)\n");
    }
    Outcome nezumi(std::vector<std::string> words, const std::string& below = "", const std::string& input = "") const {
        return run_nezumi(std::move(words), files.path(below).string(), input);
    }

    Scratch files;
};

}  // namespace

TEST_CASE("a system runs by its name, from anywhere in the project", "[cli][names]") {
    const SmallProject it;
    const std::vector<std::string> run{"run", "corridor", "--headless", "--speed", "max", "--duration", "0.1"};
    CHECK(it.nezumi(run).status == 0);
    CHECK(it.nezumi(run, "tests/deep").status == 0);
    CHECK(it.nezumi({"run", "systems/corridor", "--headless", "--speed", "max", "--duration", "0.1"}).status == 0);
    CHECK(it.nezumi({"run", "stop_at_wall", "--headless", "--speed", "max", "--duration", "0.1"}).status ==
          0);  // installed
}

TEST_CASE("a slip in a file's name gets the nearest one, whatever the command", "[cli][names]") {
    const SmallProject it;
    const Outcome run = it.nezumi({"run", "coridor"});
    CHECK(run.status == 2);
    CHECK_THAT(run.error,
               Catch::StartsWith("nezumi: there is no system file 'coridor' (did you mean 'corridor'?); looked "
                                 "for coridor.lua, behaviors/systems/coridor.lua, behaviors/coridor.lua, "));
    CHECK(it.nezumi({"run", "behaviors/systems/coridor.lua"}).error ==
          "behaviors/systems/coridor.lua: there is no such file (did you mean 'behaviors/systems/corridor.lua'?)\n");
    CHECK(it.nezumi({"test", "coridor"}).error ==
          "coridor: there is no such file or folder (did you mean 'corridor'?)\n");
    CHECK_THAT(it.nezumi({"check", "coridor"}).error, Catch::Contains("(did you mean 'corridor'?)"));
    CHECK_THAT(it.nezumi({"run", "corridor", "--params", "coridor"}).error,
               Catch::Contains("(did you mean 'corridor'?)"));
}

TEST_CASE("a slip in a path gets the nearest path, in its folders' names too, whatever the command", "[cli][names]") {
    const SmallProject it;
    const auto near = [&](const std::string& command, const std::string& path) {
        const std::string error = it.nezumi({command, path}).error;
        const auto begin = error.find("(did you mean '");
        return begin == std::string::npos ? error : error.substr(begin + 15, error.find("'?)") - begin - 15);
    };
    for (const std::string command : {"test", "check"}) {
        CHECK(near(command, "tests/coridor_test.lua") == "tests/corridor_test.lua");
        CHECK(near(command, "test/deep/oter_test.lua") == "tests/deep/other_test.lua");
        CHECK(near(command, "tests/deeep") == "tests/deep");
        CHECK(near(command, "behavors") == "behaviors");
    }
    CHECK(near("run", "behavors/system/coridor.lua") == "behaviors/systems/corridor.lua");
    CHECK(near("test", "nowhere/at/all") == "nowhere/at/all: there is no such file or folder\n");
}

TEST_CASE("nezumi check takes the names that nezumi test takes, and those of modules", "[cli][names]") {
    const SmallProject it;
    it.files.write("behaviors/lib/mine/tool.lua", "return {}\n");
    for (const std::string name : {"other", "other_test", "tests/deep/other", "tests/deep/other_test", "mine.tool"}) {
        CAPTURE(name);
        CHECK(it.nezumi({"check", name}).out == "1 file: nothing wrong\n");
        if (name != "mine.tool") CHECK(it.nezumi({"test", name, "--list"}).status == 0);
    }
}

TEST_CASE("scenarios are tested by the name of their file", "[cli][names]") {
    const SmallProject it;
    for (const std::string name : {"corridor", "corridor_test", "corridor_test.lua"}) {
        const Outcome tested = it.nezumi({"test", name, "--list"});
        CHECK(tested.status == 0);
        CHECK(tested.out.find("runs") != std::string::npos);
        CHECK(tested.out.find("idles") == std::string::npos);
    }
    CHECK(it.nezumi({"test", "other"}, "behaviors").status == 0);
    CHECK(it.nezumi({"test", "corridor"}).status == 0);
}

TEST_CASE("nezumi check reads a text from standard input", "[cli][check]") {
    const SmallProject it;
    const std::string slip = it.files.write("slip", "function on_execute()\n  oops()\nend\n").string();
    const Outcome found = it.nezumi({"check", "-"}, "", slip);
    CHECK(found.status == 1);
    CHECK(found.out == "stdin:2:3: unknown global 'oops'\n");
    CHECK(it.nezumi({"check", "-", "--name", "behaviors/new.lua"}, "", slip).out ==
          "behaviors/new.lua:2:3: unknown global 'oops'\n");
    CHECK(it.nezumi({"check", "-", "--json"}, "", slip).out ==
          "[{\"file\":\"stdin\",\"line\":2,\"column\":3,\"message\":\"unknown global 'oops'\"}]\n");
    const std::string good = it.files.write("good", "behavior 'it' { script = 'corridor' }\n").string();
    CHECK(it.nezumi({"check", "-"}, "", good).out == "stdin: nothing wrong\n");
    const std::string test = it.files.write("test", "scenario('x', function(s) s:lod 'y' end)\n").string();
    CHECK_THAT(it.nezumi({"check", "-", "--name", "tests/new_test.lua"}, "", test).out,
               Catch::StartsWith("tests/new_test.lua:1:") && Catch::Contains("did you mean 'load'?"));
    CHECK(it.nezumi({"check", "-", "."}, "", good).error ==
          "nezumi: check: - is standard input, which is one file: leave out the others\n");
}
