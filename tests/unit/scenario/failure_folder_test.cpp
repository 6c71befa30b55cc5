// Folders of failures: their names, and files that are whole or not there.
#include <catch2/catch.hpp>

#include <filesystem>

#include "bindings/scenario/failure_folder.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

TEST_CASE("the folder of a failure has the names of its file and its run", "[lua][scenario][folder]") {
    CHECK(run_file_name("tests/stop_test.lua", "drives [speed=0.1, turn=-2]", true) ==
          "stop_test-drives-speed=0.1-turn=-2");
    CHECK(run_file_name("停止_test.lua", "壁の前で止まる", true) == "停止_test-壁の前で止まる");
}

TEST_CASE("two runs with any names never share a folder for failures", "[lua][scenario][folder]") {
    const auto name = [](std::string_view run) { return run_file_name("a_test.lua", run, true); };
    CHECK(name("a/b") != name("a:b"));
    CHECK(name("a b") != name("a-b"));
    CHECK(name(std::string(200, 'x')) != name(std::string(201, 'x')));
    CHECK(run_file_name("one/a_test.lua", "x", false) != run_file_name("two/a_test.lua", "x", false));
}

TEST_CASE("the folder of a failure is below the given folder, with any name", "[lua][scenario][folder]") {
    for (const std::string_view run : {"", ".", "..", "../..", "/", "-", "\n", "a/../../b", "日本", "\xff\xfe"}) {
        for (const char* file : {".lua", "..", "...lua", "日本.lua", "-.lua", "/"}) {
            const std::string name = run_file_name(file, run, true);
            CAPTURE(file, run, name);
            CHECK_FALSE(name.empty());
            CHECK_FALSE(name.starts_with('.'));
            CHECK(name.find('/') == std::string::npos);
        }
    }
    const std::string long_name = run_file_name("a_test.lua", std::string(99, 'x') + "日本日本", true);
    CHECK(long_name.size() <= 110);
    CHECK(long_name.find("x-") != std::string::npos);  // no letter is cut in two
}

TEST_CASE("only files of an earlier failure are removed from the folder of a failure", "[lua][scenario][folder]") {
    const Scratch scratch;
    static_cast<void>(scratch.write("out/run/trace.csv", "old"));
    static_cast<void>(scratch.write("out/mine.txt", "kept"));
    REQUIRE(make_failure_folder(scratch.path("out/run")));
    CHECK(std::filesystem::is_empty(scratch.path("out/run")));
    CHECK(std::filesystem::exists(scratch.path("out/mine.txt")));
    const auto none = make_failure_folder(scratch.path("out/mine.txt/run"));
    REQUIRE_FALSE(none);
    CHECK(none.error().message.ends_with("can't be made: Not a directory"));
}
