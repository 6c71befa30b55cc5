// The files that browsers edit: whole, unchanged by others meanwhile, and never outside of the project.
#include "bindings/web/edited_files.hpp"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include "engine/base/whole_file.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::web;

namespace {

namespace fs = std::filesystem;

struct EditedProject {
    EditedProject() {
        scratch.write("project/behaviors/guide.lua", "one\n");
        scratch.write("outside/secret.lua", "secret\n");
    }
    std::string on_disk(const std::string& name) const {
        const auto text = read_whole(root / name, name);
        return text ? *text : "(" + text.error().message + ")";
    }
    std::string mark(const std::string& name) const { return files.read(name)->mark; }

    Scratch scratch;
    fs::path root = scratch.path() / "project";
    fs::path outside = scratch.path() / "outside";
    EditedFiles files{root};
};

// Writing more than this many bytes to a file fails while it exists, as on a full disk.
struct SmallDisk {
    explicit SmallDisk(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &before);
        const rlimit small{bytes, before.rlim_max};
        handler = std::signal(SIGXFSZ, SIG_IGN);
        setrlimit(RLIMIT_FSIZE, &small);
    }
    ~SmallDisk() {
        setrlimit(RLIMIT_FSIZE, &before);
        std::signal(SIGXFSZ, handler);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

    rlimit before{};
    void (*handler)(int) = nullptr;
};

}  // namespace

TEST_CASE("a file is read and written whole, and keeps its permissions", "[web][editor]") {
    EditedProject project;
    chmod((project.root / "behaviors/guide.lua").c_str(), 0755);
    const auto read = project.files.read("behaviors/guide.lua");
    REQUIRE(read);
    CHECK(read->text == "one\n");
    const auto saved = project.files.write("behaviors/guide.lua", "two\n", read->mark);
    REQUIRE(saved);
    CHECK_FALSE(saved->is_refused);
    CHECK(saved->note == "");
    CHECK(saved->mark == mark_of("two\n"));
    CHECK(project.on_disk("behaviors/guide.lua") == "two\n");
    CHECK((fs::status(project.root / "behaviors/guide.lua").permissions() & fs::perms::all) == fs::perms(0755));
    CHECK(project.files.names() == std::vector<std::string>{"behaviors/guide.lua"});
}

TEST_CASE("a file that was changed or removed meanwhile is not written", "[web][editor]") {
    EditedProject project;
    const std::string mark = project.mark("behaviors/guide.lua");
    project.scratch.write("project/behaviors/guide.lua", "theirs\n");
    auto saved = project.files.write("behaviors/guide.lua", "mine\n", mark);
    REQUIRE(saved);
    CHECK(saved->is_refused);
    REQUIRE(saved->present);
    CHECK(saved->present->text == "theirs\n");
    CHECK(project.on_disk("behaviors/guide.lua") == "theirs\n");
    CHECK(project.files.versions("behaviors/guide.lua").empty());

    saved = project.files.write("behaviors/guide.lua", "mine\n", "");  // as a new file
    REQUIRE(saved);
    CHECK(saved->is_refused);

    fs::remove(project.root / "behaviors/guide.lua");
    saved = project.files.write("behaviors/guide.lua", "mine\n", mark);
    REQUIRE(saved);
    CHECK(saved->is_refused);
    CHECK_FALSE(saved->present);
    CHECK_FALSE(fs::exists(project.root / "behaviors/guide.lua"));
    CHECK_FALSE(project.files.write("behaviors/guide.lua", "mine\n", "")->is_refused);
}

TEST_CASE("names that lead out of the project, or to hidden or other files, are refused", "[web][editor]") {
    EditedProject project;
    const std::string secret = (project.outside / "secret.lua").string();
    for (const std::string& name :
         {std::string("../outside/secret.lua"), secret, std::string("behaviors/../../outside/secret.lua"),
          std::string("./behaviors/guide.lua"), std::string("behaviors//guide.lua"), std::string("/"), std::string(""),
          std::string("behaviors/"), std::string(".nezumi/versions/x.lua"), std::string("behaviors/.hidden.lua"),
          std::string("behaviors\\guide.lua"), std::string("behaviors/guide.sh"), std::string("behaviors/a\nb.lua"),
          std::string("behaviors/a\0.lua", 16), std::string("behaviors/\xff.lua"), std::string(500, 'a') + ".lua"}) {
        INFO(name);
        CHECK_FALSE(EditedFiles::check_name(name));
        CHECK_FALSE(project.files.read(name));
        CHECK_FALSE(project.files.write(name, "attack\n", ""));
        CHECK(project.files.versions(name).empty());
        CHECK_FALSE(project.files.version(name, 1));
    }
    CHECK(EditedFiles::check_name("../x.lua").error().message ==
          "'../x.lua' is not a file name in the project: no part may be empty or begin with a dot");
    CHECK(EditedFiles::check_name("x.sh").error().message ==
          "'x.sh' can't be edited here: only files that end in .lua, .msg, .idl can");
    CHECK(EditedFiles::check_name("行動/案内.lua"));
    CHECK(project.on_disk("../outside/secret.lua") == "secret\n");
}

TEST_CASE("links are not followed, neither at the end nor on the way", "[web][editor]") {
    EditedProject project;
    fs::create_symlink(project.outside / "secret.lua", project.root / "behaviors/link.lua");
    fs::create_directory_symlink(project.outside, project.root / "behaviors/away");
    CHECK(project.files.read("behaviors/link.lua").error().message == "is a link, which is not followed");
    CHECK(project.files.read("behaviors/away/secret.lua").error().message ==
          "'away' is not a folder, or is a link, which is not followed");
    CHECK_FALSE(project.files.write("behaviors/link.lua", "attack\n", mark_of("secret\n")));
    CHECK_FALSE(project.files.write("behaviors/away/secret.lua", "attack\n", mark_of("secret\n")));
    CHECK_FALSE(project.files.write("behaviors/away/new.lua", "attack\n", ""));
    CHECK(project.files.names() == std::vector<std::string>{"behaviors/guide.lua"});
    CHECK(project.on_disk("../outside/secret.lua") == "secret\n");
    CHECK_FALSE(fs::exists(project.outside / "new.lua"));
}

TEST_CASE("the history is not written through a link", "[web][editor]") {
    EditedProject project;
    fs::create_directory_symlink(project.outside, project.root / ".nezumi");
    const auto saved = project.files.write("behaviors/guide.lua", "two\n", project.mark("behaviors/guide.lua"));
    REQUIRE(saved);
    CHECK_FALSE(saved->is_refused);
    CHECK(saved->note == "this version is not kept: '.nezumi' is not a folder, or is a link, which is not followed");
    CHECK(project.on_disk("behaviors/guide.lua") == "two\n");
    CHECK_FALSE(fs::exists(project.outside / "versions"));
}

TEST_CASE("folders, FIFOs, bytes and too long texts are refused without waiting", "[web][editor]") {
    EditedProject project;
    REQUIRE(mkfifo((project.root / "behaviors/pipe.lua").c_str(), 0600) == 0);
    fs::create_directory(project.root / "behaviors/folder.lua");
    project.scratch.write("project/behaviors/bytes.lua", "\xff\xfe");
    project.scratch.write("project/behaviors/long.lua", std::string(EditedFiles::longest_text + 1, '-'));
    CHECK(project.files.read("behaviors/pipe.lua").error().message == "is not a file");
    CHECK(project.files.read("behaviors/folder.lua").error().message == "is not a file");
    CHECK(project.files.read("behaviors/bytes.lua").error().message ==
          "is not UTF-8 text: edit it with another program");
    CHECK(project.files.read("behaviors/long.lua").error().message ==
          "has more than 256 KB: edit it with another program");
    CHECK_FALSE(project.files.write("behaviors/pipe.lua", "x", ""));
    CHECK_FALSE(project.files.write("behaviors/guide.lua", std::string(EditedFiles::longest_text + 1, '-'),
                                    project.mark("behaviors/guide.lua")));
    CHECK(project.on_disk("behaviors/guide.lua") == "one\n");
}

TEST_CASE("a full disk is reported and loses nothing", "[web][editor]") {
    EditedProject project;
    const std::string mark = project.mark("behaviors/guide.lua");
    {
        const SmallDisk full(1000);
        const auto saved = project.files.write("behaviors/guide.lua", std::string(2000, '-'), mark);
        REQUIRE_FALSE(saved);
        CHECK(describe(saved.error()) ==
              "behaviors/guide.lua: can't be written: File too large: the file is unchanged");
    }
    CHECK(project.on_disk("behaviors/guide.lua") == "one\n");
    for (const auto& entry : fs::directory_iterator(project.root / "behaviors"))
        CHECK(entry.path().filename() == "guide.lua");
    CHECK(project.files.write("behaviors/guide.lua", std::string(2000, '-'), mark));
}

TEST_CASE("the versions of a file are its first text and each saved text, at most 100", "[web][editor]") {
    EditedProject project;
    const std::string name = "behaviors/guide.lua";
    std::string mark = project.mark(name);
    for (const char* text : {"two\n", "three\n", "three\n"}) mark = project.files.write(name, text, mark)->mark;
    auto versions = project.files.versions(name);
    REQUIRE(versions.size() == 3);
    CHECK(versions[0].number == 3);
    CHECK(versions[0].bytes == 6);
    CHECK(versions[0].saved_at > 1600000000);
    CHECK(project.files.version(name, 1) == "one\n");
    CHECK(project.files.version(name, 3) == "three\n");
    CHECK(project.files.version(name, 4).error().message == "version 4 is no longer available");
    CHECK(project.on_disk(".nezumi/versions/.gitignore") == "*\n");
    CHECK(project.files.names() == std::vector<std::string>{name});

    for (int number = 4; number <= 100; ++number)
        project.scratch.write("project/.nezumi/versions/" + name + "/" + std::to_string(number), "old\n");
    REQUIRE(project.files.write(name, "newest\n", mark));
    versions = project.files.versions(name);
    CHECK(versions.size() == EditedFiles::most_versions);
    CHECK(project.files.version(name, versions[0].number) == "newest\n");
    CHECK_FALSE(project.files.version(name, 1));
}
