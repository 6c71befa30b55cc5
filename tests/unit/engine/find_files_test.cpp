// What is found in a folder and below, and what is passed over.
#include "engine/base/find_files.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
namespace fs = std::filesystem;

namespace {

using Names = std::vector<std::string>;

Names names_of(const FoundFiles& found, const fs::path& folder) {
    Names names;
    for (const fs::path& file : found.files) names.push_back(file.lexically_relative(folder).string());
    return names;
}

}  // namespace

TEST_CASE("files are found below a folder by the end of their names, in order of their paths", "[engine][base]") {
    const Scratch scratch;
    for (const char* name : {"b.lua", "a/z.lua", "a/deep/y.lua", "a.lua", "a.txt", "lua"}) scratch.write(name, "");
    const FoundFiles found = find_files(scratch.path() / "a" / "..", ".lua");
    CHECK(names_of(found, scratch.path()) == Names{"a/deep/y.lua", "a/z.lua", "a.lua", "b.lua"});
    CHECK(found.errors.empty());
    CHECK(find_files(scratch.path(), "").files.size() == 6);
}

TEST_CASE("hidden names, pipes, folders with the ending and links to folders are not found as files",
          "[engine][base]") {
    const Scratch scratch;
    scratch.write("a.lua", "");
    scratch.write(".hidden.lua", "");
    scratch.write(".git/b.lua", "");
    scratch.write("folder.lua/c.lua", "");
    REQUIRE(mkfifo(scratch.path("pipe.lua").c_str(), 0600) == 0);
    fs::create_directory_symlink(scratch.path(), scratch.path("folder.lua/circle.lua"));
    fs::create_symlink("nowhere", scratch.path("broken.lua"));
    fs::create_symlink("a.lua", scratch.path("link.lua"));  // to a file: one
    const FoundFiles found = find_files(scratch.path(), ".lua");
    CHECK(names_of(found, scratch.path()) == Names{"a.lua", "folder.lua/c.lua", "link.lua"});
    CHECK(found.errors.empty());
}

TEST_CASE("a folder that can't be read is named, and costs no other", "[engine][base]") {
    const Scratch scratch;
    const auto error_of = [&](const fs::path& folder) {
        const FoundFiles found = find_files(folder, "");
        CHECK(found.files.empty());
        return found.errors.size() == 1 ? describe(found.errors.front()) : "no single error";
    };
    CHECK(error_of(scratch.path("missing")) ==
          scratch.path("missing").string() + ": can't be read: No such file or directory");
    CHECK(error_of(scratch.write("file", "")) == scratch.path("file").string() + ": can't be read: Not a directory");
    fs::create_symlink("circle", scratch.path("circle"));
    CHECK(error_of(scratch.path("circle")) ==
          scratch.path("circle").string() + ": can't be read: Too many levels of symbolic links");
    if (geteuid() == 0) return;  // who may read everything
    scratch.write("all/locked/a", "");
    scratch.write("all/open/b", "");
    fs::permissions(scratch.path("all/locked"), fs::perms::none);
    const FoundFiles found = find_files(scratch.path("all"), "");
    fs::permissions(scratch.path("all/locked"), fs::perms::owner_all);
    CHECK(names_of(found, scratch.path("all")) == Names{"open/b"});
    REQUIRE(found.errors.size() == 1);
    CHECK(describe(found.errors.front()) == scratch.path("all/locked").string() + ": can't be read: Permission denied");
}
