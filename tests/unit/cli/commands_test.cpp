// The executable, as a person calls it to write and check behaviours: what it says where, and its exit status.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "engine/ports/messages.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

TEST_CASE("nezumi types shows all types, some, or says what is near", "[cli][types]") {
    CHECK(run_nezumi({"types"}).out.find("\nTimedShort: one 16-bit integer\n") != std::string::npos);
    const Outcome one = run_nezumi({"types", "TimedVelocity2D"});
    CHECK(one.status == 0);
    CHECK(one.out.find("TimedVelocity2D: a velocity in the robot's own frame\n  vx ") == 0);
    CHECK(run_nezumi({"types", "--lua"}).out.find("---@meta\n") == 0);

    const Outcome slip = run_nezumi({"types", "TimedVelocity2d"});
    CHECK(slip.status == 2);
    CHECK(slip.out.empty());
    CHECK(slip.error ==
          "nezumi: types: there is no message type 'TimedVelocity2d' (did you mean 'TimedVelocity2D'?); `nezumi types` "
          "shows all\n");
    CHECK(run_nezumi({"types", "--lua", "TimedShort"}).status == 2);
}

TEST_CASE("nezumi check ends with 0, 1 or 2", "[cli][check]") {
    const Scratch files;
    files.write("behaviors/good.lua", "function on_execute() end\n");
    files.write("behaviors/bad.lua", "function on_execute()\n  oops()\nend\n");
    const std::string folder = files.path("").string();

    const Outcome good = run_nezumi({"check", "behaviors/good.lua"}, folder);
    CHECK(good.status == 0);
    CHECK(good.out == "1 file: nothing wrong\n");
    const Outcome good_json = run_nezumi({"check", "--json", "behaviors/good.lua"}, folder);
    CHECK(good_json.status == 0);
    CHECK(good_json.out == "[]\n");

    const Outcome bad = run_nezumi({"check", "."}, folder);
    CHECK(bad.status == 1);
    CHECK(bad.out == "behaviors/bad.lua:2:3: unknown global 'oops'\n");
    CHECK(bad.error.empty());
    CHECK(run_nezumi({"check", ".", "--json"}, folder).out ==
          "[{\"file\":\"behaviors/bad.lua\",\"line\":2,\"column\":3,\"message\":\"unknown global 'oops'\"}]\n");

    const Outcome missing = run_nezumi({"check", "behaviors/goood.lua"}, folder);
    CHECK(missing.status == 2);
    CHECK(missing.out.empty());
    CHECK(missing.error == "behaviors/goood.lua: there is no such file (did you mean 'behaviors/good.lua'?)\n");
    CHECK(run_nezumi({"check"}, folder).status == 1);
}

TEST_CASE("nezumi check says what it could not read, and checks the rest", "[cli][check]") {
    const Scratch files;
    files.write("behaviors/bad.lua", "function on_execute()\n  oops()\nend\n");
    std::filesystem::create_directories(files.path("behaviors/folder.lua"));
    std::filesystem::create_symlink("nowhere", files.path("behaviors/lost.lua"));
    REQUIRE(mkfifo(files.path("behaviors/pipe.lua").c_str(), 0600) == 0);
    const std::string folder = files.path("").string();
    const Outcome some = run_nezumi({"check", "no.lua", "."}, folder);
    CHECK(some.status == 2);
    CHECK(some.error == "no.lua: there is no such file\n");
    CHECK(some.out == "behaviors/bad.lua:2:3: unknown global 'oops'\n");
    CHECK(run_nezumi({"check", "."}, folder).status == 1);
}

TEST_CASE("without a command nezumi says what there is", "[cli]") {
    const std::string known =
        "; known are run, attach, calc, types, check, list, new, test, doctor, calibrate, push, "
        "receive, marker, network, completion, manual";
    const std::string none = "nezumi: what is to be done? See nezumi --help" + known + "\n";
    CHECK(run_nezumi({}).error == none);
    CHECK(run_nezumi({}).status == 2);
    CHECK(run_nezumi({"--"}).error == none);
    CHECK(run_nezumi({""}).error == "nezumi: there is no command ''" + known + "\n");
    CHECK(run_nezumi({"--versio"}).error ==
          "nezumi: there is no option '--versio' (did you mean '--version'?); see nezumi --help\n");
    CHECK(run_nezumi({"new", "behavior"}).error == "nezumi: NAME is missing; see nezumi new behavior --help\n");
}

TEST_CASE("what can't be said on standard output costs the exit status, whatever the command", "[cli]") {
    const Scratch files;
    const std::string folder = files.path("").string();
    files.write("behaviors/it.lua", "function on_execute() end\n");
    files.write("it_test.lua", "scenario('a', function() end)\n");
    files.write("it.lua", "arena { size = { 1, 1 } }\n");
    files.write("commands", "print('said')\n");
    for (const std::vector<std::string>& words : {std::vector<std::string>{"types"},
                                                  {"types", "--lua"},
                                                  {"check", "behaviors"},
                                                  {"--help"},
                                                  {"--version"},
                                                  {"test", "it_test.lua"},
                                                  {"test", "it_test.lua", "--list"},
                                                  {"test", "it_test.lua", "--tap"},
                                                  {"new", "project", "p"},
                                                  {"run", "it.lua", "--batch"},
                                                  {"run", "it.lua", "--headless", "--duration", "0", "--trace-hash"}}) {
        INFO(words.front() << " " << words.back());
        const Outcome full = run_with_output("/dev/full", words, folder, "commands");
        CHECK(full.status == 2);
        CHECK(full.error.find("nezumi: standard output can't be written") != std::string::npos);
        CHECK(full.error.find("trace hash") == std::string::npos);  // one line for one error
        std::filesystem::remove_all(files.path("p"));
        CHECK(run_with_output("", words, folder, "commands").status == 2);
        std::filesystem::remove_all(files.path("p"));
    }
}

TEST_CASE("a standard error that is full or closed crashes nothing", "[cli]") {
    const Scratch files;
    const std::string folder = files.path("").string();
    files.write("it.lua", "arena { size = { 1, 1 } }\n");
    files.write("commands", "x.y\nprint('said')\n");
    for (const char* target : {"/dev/full", ""}) {
        CHECK(run_with_error(target, {"run", "no.lua"}, folder).status == 2);
        const Outcome batch = run_with_error(target, {"run", "it.lua", "--batch"}, folder, "commands");
        CHECK(batch.status == 1);
        CHECK(batch.out == "said\n");
        CHECK(run_with_error(target, {"run", "it.lua", "--headless", "--duration", "0"}, folder).status == 0);
        const Outcome recorded =
            run_with_error(target, {"run", "it.lua", "--headless", "--duration", "0", "--record", "it.csv"}, folder);
        CHECK(recorded.status == 0);
        CHECK(std::filesystem::file_size(files.path("it.csv")) == 5);  // "time\n", and nothing meant for a person
    }
}

TEST_CASE("nezumi new writes a behaviour that passes nezumi check, and never twice", "[cli][new]") {
    const Scratch files;
    const std::string folder = files.path("").string();
    const std::vector<std::string> words{
        "new",     "behavior",  "--in", "in:TimedShortSeq", "LineFollower", "--out", "out:TimedVelocity2D",
        "--param", "speed=-0.1"};
    const Outcome first = run_nezumi(words, folder);
    CHECK(first.status == 0);
    CHECK(first.out ==
          "wrote behaviors/line_follower.lua\n"
          "wrote tests/line_follower_test.lua\n"
          "now try: nezumi test tests/line_follower_test.lua\n");
    CHECK(run_nezumi({"check", "."}, folder).out == "2 files: nothing wrong\n");
    CHECK(run_nezumi({"test"}, folder).status == 0);

    const Outcome second = run_nezumi(words, folder);
    CHECK(second.status == 2);
    CHECK(second.error ==
          "behaviors/line_follower.lua: exists already, and nothing is overwritten: choose another name or move it "
          "away\n");
}

TEST_CASE("what nezumi new writes passes its own scenario whatever the types and names", "[cli][new]") {
    const Scratch files;
    const std::string folder = files.path("").string();
    std::vector<std::string> all{"new", "behavior", "all_types"};
    for (const std::string_view type : message_type_names) {
        const std::string port = "_" + std::to_string(all.size()) + ":" + std::string(type);
        all.insert(all.end(), {"--in", "in" + port, "--out", "out" + port});
    }
    for (const std::vector<std::string>& words : {all,
                                                  {"new", "behavior", "bare"},
                                                  {"new", "behavior", "watch", "--out", "end:TimedShort"},
                                                  {"new", "behavior", "table", "--in", "in:TimedString"},
                                                  {"new", "behavior", "s", "--out", "world:TimedPose3D"}}) {
        CHECK(run_nezumi(words, folder).status == 0);
    }
    CHECK(run_nezumi({"check", "."}, folder).status == 0);
    const Outcome tested = run_nezumi({"test"}, folder);
    INFO(tested.out << tested.error);
    CHECK(tested.status == 0);
    CHECK(tested.out.find("5 runs: 5 passed") != std::string::npos);
}

TEST_CASE("nezumi new behavior finds its project from below, and its folder of scenarios", "[cli][new]") {
    const Scratch files;
    files.write("behaviors/systems/room.lua", "");
    files.write("tests/scenarios/any_test.lua", "");
    const Outcome made = run_nezumi({"new", "behaviour", "blink"}, files.path("behaviors/systems").string());
    CHECK(made.status == 0);
    CHECK(std::filesystem::exists(files.path("behaviors/blink.lua")));
    CHECK(std::filesystem::exists(files.path("tests/scenarios/blink_test.lua")));
}

TEST_CASE("nezumi new project writes into a folder that is new or empty", "[cli][new]") {
    const Scratch files;
    const std::string folder = files.path("").string();
    files.write("full/note.txt", "");
    std::filesystem::create_directories(files.path("cloned/.git"));

    CHECK(run_nezumi({"new", "project", "robots"}, folder).status == 0);
    CHECK(run_nezumi({"new", "project", "cloned"}, folder).status == 0);
    CHECK(run_nezumi({"check", "robots", "cloned"}, folder).out == "6 files: nothing wrong\n");
    CHECK(std::filesystem::exists(files.path("robots/.luarc.json")));
    CHECK(run_nezumi({"test"}, files.path("robots").string()).status == 0);

    const Outcome full = run_nezumi({"new", "project", "full"}, folder);
    CHECK(full.status == 2);
    CHECK(full.error == "full: is not empty (it has 'note.txt'), and nothing is overwritten: choose another folder\n");
    CHECK(run_nezumi({"new", "project", ""}, folder).error == "nezumi: new project: expected a folder, got ''\n");
    CHECK_FALSE(std::filesystem::exists(files.path("behaviors")));
    CHECK(run_nezumi({"new", "project", "it's mine"}, folder)
              .out.ends_with("now try: cd 'it'\\''s mine' && nezumi test\n"));
    CHECK(run_nezumi({"new", "behavior", "Foo Bar"}, folder).error.ends_with("(did you mean 'foo_bar'?)\n"));
    CHECK(run_nezumi({"new", "project", "full/note.txt"}, folder).error ==
          "full/note.txt: is a file, expected a folder that is new or empty\n");
}

TEST_CASE("nezumi new says in one line what there is to write", "[cli][new]") {
    CHECK(
        run_nezumi({"new", "behavoir", "x"}).error ==
        "nezumi: new: there is no 'behavoir' (did you mean 'behavior'?). Write `nezumi new behavior NAME`, `nezumi new "
        "system NAME`, `nezumi new robot NAME`, `nezumi new scenario NAME` or `nezumi new project DIR`\n");
    CHECK(run_nezumi({"new"}).status == 2);
    CHECK(run_nezumi({"new", "behavior", "x", "--inn", "a:TimedShort"}).status == 2);
    for (const std::vector<std::string>& words : {std::vector<std::string>{"new", "--help"},
                                                  {"new", "behavior", "--help"},
                                                  {"check", "--help"},
                                                  {"types", "--help"}}) {
        CHECK(run_nezumi(words).status == 0);
    }
}
