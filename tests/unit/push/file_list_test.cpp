// Lists of files as text.
#include "bindings/push/file_list.hpp"

#include <catch2/catch.hpp>
#include <string>

using namespace nezumi;
using namespace nezumi::push;

namespace {

const std::string digits(64, 'a');

FileList one_file(const std::string& name) { return {{name, {.kind = ListedFile::Kind::file, .hash = digits}}}; }

}  // namespace

TEST_CASE("a list of files with any names is read as it was written", "[push]") {
    FileList list{{"behaviors", {.kind = ListedFile::Kind::folder}},
                  {"behaviors/way", {.kind = ListedFile::Kind::link, .hash = digits}},
                  {"tool", {.kind = ListedFile::Kind::program, .hash = digits}}};
    for (const char* name : {"-rf", ":x", "a b", "new\nline", "quo'te\"", "back\\slash", "\xff\x01", "$(touch x)",
                             "...", "a/.nezumi-push"})
        list.merge(one_file(name));
    CHECK(read_file_list(to_text(list)) == list);
    CHECK(read_file_list(to_text({})) == FileList{});
    CHECK(to_text(one_file("a \"b")) == "nezumi files 1\nfile " + digits + " \"a \\\"b\"\nend 1\n");
}

TEST_CASE("a list truncated anywhere is refused", "[push]") {
    const std::string text = to_text(one_file("behaviors/drive.lua"));
    for (std::size_t size = 0; size + 1 < text.size(); ++size) {
        CAPTURE(size);
        const auto list = read_file_list(text.substr(0, size));
        REQUIRE_FALSE(list);
        CHECK(list.error().message == "is damaged: remove it on the robot, then push again");
    }
}

TEST_CASE("a list with a name that leads out of its folder, or to the push's own, is refused", "[push]") {
    for (const char* name : {"/etc/passwd", "../x", "a/../../x", "a/..", "..", ".", "a//b", "a/", "", ".nezumi-push",
                             ".nezumi-push/list"}) {
        CAPTURE(name);
        CHECK_FALSE(read_file_list(to_text(one_file(name))));
    }
    CHECK_FALSE(read_file_list(to_text(one_file(std::string("a\0b", 3)))));
}
