// The pages of this user's running systems.
#include "bindings/web/page_directory.hpp"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/web/web_rig.hpp"

using namespace nezumi;
using namespace nezumi::web;

namespace {

RunningPage page_of(const std::string& name, pid_t process) {
    return {.name = name,
            .process = process,
            .url = "http://127.0.0.1:8765/#0123abcd",
            .view_url = "http://127.0.0.1:8765/#dcba3210"};
}

// The number of a process that has ended.
pid_t ended_process() {
    const pid_t child = fork();
    if (child == 0) _exit(0);
    waitpid(child, nullptr, 0);
    return child;
}

}  // namespace

TEST_CASE("a page is listed while its entry exists, only for its user", "[web][pages]") {
    const Scratch scratch;
    {
        const auto entry = PageEntry::open(page_of("wall", getpid()), scratch.path());
        REQUIRE(entry);
        CHECK(running_pages(scratch.path()) == std::vector<RunningPage>{page_of("wall", getpid())});
        struct stat status {};
        REQUIRE(stat(entry->file().c_str(), &status) == 0);
        CHECK((status.st_mode & 0777) == 0600);
        CHECK(entry->file().string().find("0123abcd") == std::string::npos);
    }
    CHECK(running_pages(scratch.path()).empty());
}

TEST_CASE("the page of an ended process is no longer listed, and its file is removed", "[web][pages]") {
    const Scratch scratch;
    const pid_t gone = ended_process();
    const auto entry = PageEntry::open(page_of("wall", gone), scratch.path());
    REQUIRE(entry);
    CHECK(running_pages(scratch.path()).empty());
    CHECK_FALSE(std::filesystem::exists(entry->file()));
}

TEST_CASE("a file that is not a page is not listed", "[web][pages]") {
    const Scratch scratch;
    const std::string process = std::to_string(getpid());
    scratch.write("wall-" + process + ".sock", "");
    scratch.write("empty-" + process + ".html", "");
    scratch.write("script-" + process + ".html",
                  "content=\"0; url=javascript:alert(1)\" <!-- view: http://127.0.0.1/#1 -->");
    scratch.write("quoted-" + process + ".html",
                  "content=\"0; url=http://127.0.0.1/<script>\" <!-- view: http://127.0.0.1/#1 -->");
    scratch.write("nobody.html", "content=\"0; url=http://127.0.0.1/#1\"");
    CHECK(running_pages(scratch.path()).empty());
    CHECK(running_pages(scratch.path("nowhere")).empty());
    chmod(scratch.path().c_str(), 0755);
    const auto entry = PageEntry::open(page_of("wall", getpid()), scratch.path());
    CHECK(running_pages(scratch.path()).empty());  // others can enter
}

TEST_CASE("a browser gets a list of the other systems, with the same permission as here", "[web][pages]") {
    const Scratch scratch;
    setenv("XDG_RUNTIME_DIR", scratch.path().c_str(), 1);
    const auto folder = scratch.path("nezumi");
    mkdir(folder.c_str(), 0700);
    const auto here = PageEntry::open(page_of("here", getpid()), folder);
    const auto other = PageEntry::open(page_of("other", getppid()), folder);
    {
        WebRig rig;
        for (const bool may_act : {true, false}) {
            RawBrowser browser = rig.open(may_act ? rig.token : rig.view_token);
            REQUIRE(browser.send_frame(R"({"do":"systems"})"));
            const auto systems = WebRig::Json::parse(browser.next_text("\"is\":\"systems\""))["systems"];
            REQUIRE(systems.size() == 2);
            CHECK(systems[0]["here"] == true);
            CHECK(systems[0]["url"].get<std::string>().empty());
            CHECK(systems[1]["name"] == "other");
            CHECK(systems[1]["url"] == (may_act ? page_of("", 1).url : page_of("", 1).view_url));
        }
    }
    unsetenv("XDG_RUNTIME_DIR");
}

TEST_CASE("a system's name is not used as a path", "[web][pages]") {
    const Scratch scratch;
    const auto entry = PageEntry::open(page_of("../a b\"<", getpid()), scratch.path());
    REQUIRE(entry);
    CHECK(entry->file().parent_path() == scratch.path());
    CHECK(running_pages(scratch.path()).front().name == "___a_b__");
}
