// A pupil's copy of an exercise on the disk.
#include "bindings/web/classroom/work_folder.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "bindings/web/classroom/exercises.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::web;

namespace {

namespace fs = std::filesystem;

std::string why_not(const Expected<void>& fits) { return fits ? "" : fits.error().message; }

}  // namespace

TEST_CASE("files as the exercise has them are not saved ones", "[web][class]") {
    const Scratch scratch;
    scratch.write("start/behaviors/a.lua", "return 1");
    scratch.write("start/tests/a_test.lua", "return 2");
    const auto hours_ago = fs::file_time_type::clock::now() - std::chrono::hours(5);
    fs::last_write_time(scratch.path("start/behaviors/a.lua"), hours_ago);
    REQUIRE(copy_files(scratch.path("start"), scratch.path("work"), false));
    const auto given = look_at_work(scratch.path("work"), scratch.path("start"));
    CHECK(given.last_save == 0);
    CHECK(given.files == 2);
    CHECK(given.bytes == 16);
    scratch.write("work/behaviors/a.lua", "return 1");  // the same text, saved by the pupil
    CHECK(look_at_work(scratch.path("work"), scratch.path("start")).last_save > 0);
}

TEST_CASE("a save that needs more than the quota is refused, a shorter text never", "[web][class]") {
    const Scratch scratch;
    const Quota quota{.bytes = 3 << 20, .files = 2};
    scratch.write("behaviors/a.lua", std::string(1 << 20, ' '));
    scratch.write(".nezumi/versions/behaviors/a.lua/1", std::string(3 << 20, ' '));
    CHECK(why_not(check_quota(scratch.path(), "behaviors/b.lua", std::string(2 << 20, ' '), quota)).empty());
    CHECK(why_not(check_quota(scratch.path(), "behaviors/b.lua", std::string((2 << 20) + (1 << 19), ' '), quota)) ==
          "nothing was saved: your files would have 3.5 MB, and at most 3.0 MB are allowed");
    CHECK(why_not(check_quota(scratch.path(), "behaviors/a.lua", std::string(3 << 20, ' '), quota)).empty());
    scratch.write("behaviors/b.lua", std::string(4 << 20, ' '));
    CHECK(why_not(check_quota(scratch.path(), "behaviors/b.lua", std::string((4 << 20) - 1, ' '), quota)).empty());
    CHECK(why_not(check_quota(scratch.path(), "behaviors/c.lua", "", quota)) ==
          "nothing was saved: you have 2 files, and no more are allowed");
    CHECK(why_not(check_quota(scratch.path(), "../c.lua", "x", quota)).empty());  // the editor refuses such names
}

TEST_CASE("the oldest versions go first when they have too many bytes", "[web][class]") {
    const Scratch scratch;
    const auto now = fs::file_time_type::clock::now();
    for (const int number : {1, 2, 3}) {
        const std::string name = ".nezumi/versions/behaviors/a.lua/" + std::to_string(number);
        scratch.write(name, std::string(100, ' '));
        fs::last_write_time(scratch.path(name), now - std::chrono::hours(10 - number));
    }
    trim_versions(scratch.path(), 300);
    CHECK(fs::exists(scratch.path(".nezumi/versions/behaviors/a.lua/1")));
    trim_versions(scratch.path(), 250);
    CHECK_FALSE(fs::exists(scratch.path(".nezumi/versions/behaviors/a.lua/1")));
    CHECK(fs::exists(scratch.path(".nezumi/versions/behaviors/a.lua/2")));
}

TEST_CASE("files that a program writes count, and are removed when they are too large", "[web][class]") {
    const Scratch scratch;
    const Quota quota{.bytes = 1 << 20, .files = 3};
    scratch.write("start/behaviors/a.lua", "return 1");
    scratch.write("start/map.csv", std::string(3 << 20, '1'));
    REQUIRE(copy_files(scratch.path("start"), scratch.path("work"), false));
    scratch.write("work/behaviors/b.lua", "return 2");
    scratch.write("work/nezumi-test/failed/trace.csv", std::string(1 << 19, ' '));
    const auto look = [&] { return enforce_quota(scratch.path("work"), scratch.path("start"), quota); };
    CHECK_FALSE(look());  // what the exercise has does not count
    scratch.write("work/.nezumi/versions/behaviors/b.lua/1", std::string(2 << 20, ' '));
    CHECK_FALSE(look());  // versions have a limit of their own

    SECTION("bytes, also of hidden files") {
        scratch.write("work/.nezumi/kept.mcap", std::string(3 << 19, ' '));
        const auto over = look();
        REQUIRE(over);
        CHECK(over->why ==
              "too much was written: 2.0 MB in 3 files, and at most 1.0 MB in 3 files are allowed; files removed "
              "because they are not text: 2");
        CHECK(over->removed == 2);
        CHECK_FALSE(look());
    }
    SECTION("files") {
        for (const char* name : {"1.svg", "2.svg", "3.svg"}) scratch.write(std::string("work/") + name, "x");
        const auto over = look();
        REQUIRE(over);
        CHECK(over->removed == 4);
    }
    SECTION("texts are never removed") {
        for (const char* name : {"1.lua", "2.lua", "3.lua"}) scratch.write(std::string("work/") + name, "x");
        static_cast<void>(look());
        const auto over = look();
        REQUIRE(over);
        CHECK(over->why ==
              "too much was written: 0.0 MB in 4 files, and at most 1.0 MB in 3 files are allowed; make the texts "
              "shorter");
        CHECK(fs::exists(scratch.path("work/3.lua")));
    }
    CHECK(fs::exists(scratch.path("work/behaviors/b.lua")));
    CHECK(fs::exists(scratch.path("work/map.csv")));
    CHECK(fs::exists(scratch.path("work/.nezumi/versions/behaviors/b.lua/1")));
}
