// What a disk that is full leaves of a file, and of the older file of its name.
#include "engine/base/result_file.hpp"

#include <catch2/catch.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include <string>

#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

ResultFile written(const std::string& file, const std::string& text) {
    auto opened = ResultFile::open(file);
    REQUIRE(opened);
    REQUIRE(write(opened->descriptor(), text.data(), text.size()) == static_cast<ssize_t>(text.size()));
    close(opened->descriptor());
    return *opened;
}

}  // namespace

TEST_CASE("the older file has another name until the new one is whole", "[files]") {
    const Scratch scratch;
    const std::string file = scratch.write("r.csv", "older").string();
    const std::string other = scratch.write("r.csv~", "of somebody else").string();
    chmod(file.c_str(), 0640);
    ResultFile result = written(file, "newer");
    CHECK(result.set_aside() == result.path() + "~2");
    CHECK(text_of_file(file + "~2") == "older");
    struct stat status {};
    REQUIRE(stat(file.c_str(), &status) == 0);
    CHECK((status.st_mode & 0777) == 0640);
    SECTION("it goes then") {
        result.replace_older();
        CHECK(text_of_file(file) == "newer");
        CHECK_FALSE(std::filesystem::exists(file + "~2"));
    }
    SECTION("or comes back") {
        result.discard();
        CHECK(text_of_file(file) == "older");
        CHECK_FALSE(std::filesystem::exists(file + "~2"));
    }
    CHECK(text_of_file(other) == "of somebody else");
}

TEST_CASE("a link stays a link, and a file that is new leaves nothing", "[files]") {
    const Scratch scratch;
    const std::string file = scratch.write("r.csv", "older").string(), link = scratch.path("link.csv").string();
    std::filesystem::create_symlink(file, link);
    ResultFile linked = written(link, "newer");
    linked.replace_older();
    CHECK(std::filesystem::is_symlink(link));
    CHECK(text_of_file(file) == "newer");
    ResultFile fresh = written(scratch.path("fresh.csv").string(), "x");
    CHECK(fresh.set_aside().empty());
    fresh.discard();
    CHECK_FALSE(std::filesystem::exists(scratch.path("fresh.csv")));
    CHECK(ResultFile::open("/dev/null")->path().empty());
    CHECK(describe(ResultFile::open(scratch.path("none/r.csv").string()).error()) ==
          scratch.path("none/r.csv").string() + ": can't be written: No such file or directory");
}

TEST_CASE("a file that was cut off ends with its last whole row and a note", "[files]") {
    const Scratch scratch;
    const std::string file = scratch.path("r.csv").string();
    const auto cut = [&](const std::string& text, std::uint64_t from) {
        written(file, text).cut_to_rows(from, "# note\n");
        return text_of_file(file);
    };
    CHECK(cut("time\n1\n2\n3.33", 0) == "time\n1\n2\n# note\n");
    CHECK(cut("time\n1\n2\n3.33", 7) == "time\n1\n2\n# note\n");
    CHECK(cut("time\n1\n2\n", 0) == "time\n1\n2\n# note\n");
    CHECK(cut("time,x\n1,\"a\nb\"\n2,\"c\nd", 0) == "time,x\n1,\"a\nb\"\n# note\n");
    CHECK(cut("time,x\n1,5\" wide\n2,3", 0) == "time,x\n1,5\" wide\n# note\n");
    CHECK(cut("", 0) == "# note\n");
    CHECK(cut("ti", 0) == "# note\n");
    CHECK(cut("time\n", 100) == "time\n# note\n");
}
