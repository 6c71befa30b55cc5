// Names of files that a command is to write.
#include "bindings/cli/files/output_files.hpp"

#include <catch2/catch.hpp>

#include <filesystem>

#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::cli;

TEST_CASE("a file is tried without leaving a trace", "[cli]") {
    const Scratch scratch;
    const std::string there = scratch.path("a.png").string();
    CHECK(check_can_write(there));
    CHECK_FALSE(std::filesystem::exists(there));
    scratch.write("b.png", "mine");
    CHECK(check_can_write(scratch.path("b.png").string()));
    CHECK(text_of_file(scratch.path("b.png").string()) == "mine");
    CHECK_FALSE(check_can_write(scratch.path("none/a.png").string()));
}
