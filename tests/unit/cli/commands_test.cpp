// The executable, as a person calls it to write and check behaviours: what it says where, and its exit status.
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

TEST_CASE("every command fails if standard output can't be written", "[cli]") {
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
