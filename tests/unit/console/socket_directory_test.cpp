// Only the user of a system can find it and attach to it.
#include "bindings/console/socket_directory.hpp"

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

std::string refusal(std::string_view which, const std::filesystem::path& folder) {
    const auto socket = connect_to_system(which, folder);
    return socket ? "none" : socket.error().message;
}

}  // namespace

TEST_CASE("a listening system is found by its name, by its process, or as the only one", "[console][attach]") {
    const Scratch folder;
    const std::string process = std::to_string(getpid());
    CHECK(refusal("", folder.path() / "none") == "nothing is running: start a system with `nezumi run FILE`");
    {
        const auto listener = Listener::open("stop_at_wall", folder.path());
        REQUIRE(listener);
        CHECK(refusal("", folder.path()) == "none");
        CHECK(refusal("stop_at_wall", folder.path()) == "none");
        CHECK(refusal(process, folder.path()) == "none");
        CHECK(refusal("stop_at_wal", folder.path()) ==
              "no system 'stop_at_wal' is running (did you mean 'stop_at_wall'?); running: stop_at_wall (process " +
                  process + ")");
        const auto other = Listener::open("line follower", folder.path());
        REQUIRE(other);
        CHECK(refusal("", folder.path()) ==
              "several systems are running, choose one by its name or process number: line follower (process " +
                  process + "), stop_at_wall (process " + process + ")");
        CHECK(refusal("line follower", folder.path()) == "none");
    }
    CHECK(std::filesystem::is_empty(folder.path()));
    CHECK(refusal("", folder.path()) == "nothing is running: start a system with `nezumi run FILE`");
}

TEST_CASE("a system has the name of its file, for every file name", "[console][attach]") {
    const Scratch folder;
    for (const std::string& name :
         std::vector<std::string>{"maze-solver", "v1.2", "line follower", "\xe8\xbf\xb7\xe8\xb7\xaf", "a-12.sock",
                                  "it's \"mine\"", std::string(60, 'n'), std::string(240, 'n')}) {
        INFO(name);
        const auto listener = Listener::open(name, folder.path());
        REQUIRE(listener);
        const auto systems = running_systems(folder.path());
        REQUIRE(systems);
        REQUIRE(systems->size() == 1);
        CHECK(systems->front().name == name);
        CHECK(refusal(name, folder.path()) == "none");
        CHECK(refusal("behaviors/systems/" + name + ".lua", folder.path()) == "none");
    }
}

TEST_CASE("sockets without a listener are removed, other files are not", "[console][attach]") {
    const Scratch folder;
    const auto living = Listener::open("living", folder.path());
    REQUIRE(living);
    {
        // What a process leaves that was killed.
        auto killed = Listener::open("killed", folder.path());
        REQUIRE(killed);
        std::filesystem::rename(killed->path(), folder.path() / "dead-12345.sock");
    }
    std::ofstream(folder.path() / "notes.txt") << "mine";
    CHECK(refusal("", folder.path()) == "none");
    CHECK_FALSE(std::filesystem::exists(folder.path() / "dead-12345.sock"));
    CHECK(std::filesystem::exists(folder.path() / "notes.txt"));
    CHECK(std::filesystem::exists(living->path()));
}

TEST_CASE("the folder is created for its user only, and any other folder is refused", "[console][attach]") {
    const Scratch parent;
    const std::filesystem::path folder = parent.path() / "nezumi";
    {
        const auto listener = Listener::open("a", folder);
        REQUIRE(listener);
        struct stat status {};
        REQUIRE(stat(folder.c_str(), &status) == 0);
        CHECK((status.st_mode & 0777) == 0700);
        REQUIRE(stat(listener->path().c_str(), &status) == 0);
        CHECK((status.st_mode & 0777) == 0600);
    }
    std::filesystem::permissions(folder, std::filesystem::perms(0755));
    const auto open_to_all = Listener::open("a", folder);
    REQUIRE_FALSE(open_to_all);
    CHECK(open_to_all.error().message ==
          "other users can enter the console's folder " + folder.string() + ": run chmod 700 on it");
    CHECK(refusal("", folder) == open_to_all.error().message);

    std::filesystem::permissions(folder, std::filesystem::perms(0700));
    std::filesystem::create_directory_symlink(folder, parent.path() / "link");
    const auto link = Listener::open("a", parent.path() / "link");
    REQUIRE_FALSE(link);
    CHECK(link.error().message ==
          "can't open the console's folder " + (parent.path() / "link").string() + ": Not a directory");
}

TEST_CASE("a folder's path may be longer than a socket's address", "[console][attach]") {
    const Scratch parent;
    const std::filesystem::path deep = parent.path() / std::string(100, 'a') / std::string(100, 'b');
    std::filesystem::create_directories(deep);
    const auto listener = Listener::open(std::string(300, 'n') + "/../x", deep / "nezumi");
    REQUIRE(listener);
    CHECK(refusal("", deep / "nezumi") == "none");
}

TEST_CASE("the user at the other end of a socket is known", "[console][attach]") {
    int ends[2] = {-1, -1};
    REQUIRE(socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0);
    const Descriptor one(ends[0]);
    const Descriptor other(ends[1]);
    CHECK(is_peer(one.get(), geteuid()));
    CHECK_FALSE(is_peer(one.get(), geteuid() + 1));
}

TEST_CASE("the folder is in the runtime directory of the user, or in /tmp", "[console][attach]") {
    const char* before = std::getenv("XDG_RUNTIME_DIR");
    const std::string kept = before != nullptr ? before : "";
    const Scratch runtime;
    setenv("XDG_RUNTIME_DIR", runtime.path().c_str(), 1);
    CHECK(console_folder() == runtime.path() / "nezumi");
    const std::string own = "/tmp/nezumi-" + std::to_string(geteuid());
    setenv("XDG_RUNTIME_DIR", "/nowhere", 1);
    CHECK(console_folder() == own);
    unsetenv("XDG_RUNTIME_DIR");
    CHECK(console_folder() == own);
    if (before != nullptr) setenv("XDG_RUNTIME_DIR", kept.c_str(), 1);
}
