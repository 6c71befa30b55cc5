// `nezumi push` that is cut: by the connection, by the end of a side.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/cli/ssh_server.hpp"

using namespace nezumi;
namespace fs = std::filesystem;

TEST_CASE("a project that can't come over whole leaves the robot as it was", "[cli][push]") {
    const SshServer server;
    const PushedProject project;
    REQUIRE(project.push(server).status == 0);
    project.folder.write("robots/behaviors/drive.lua", "-- second" + std::string(300'000, '.'));
    // The connection breaks in the middle, or the robot's side dies.
    for (const std::string& words :
         std::vector<std::string>{"dd bs=1 count=200000 status=none | " + nezumi_program() + " receive", "sleep 0.1"}) {
        server.receive_by(words);
        const Outcome broken = project.push(server);
        CHECK(broken.status == 2);
        CHECK(broken.error == "nezumi: mouse: the connection broke: nothing was changed on the robot\n");
        CHECK(server.there("robots/behaviors/drive.lua") == "-- first\n");
    }
    fs::remove(server.folder.path("bin/nezumi"));
    CHECK(project.push(server).status == 0);
    CHECK(server.there("robots/behaviors/drive.lua").starts_with("-- second"));
}

TEST_CASE(
    "the robot's side, killed at any step of a push by ssh, leaves the old or the new project, and the next finishes",
    "[cli][push]") {
    if (access("/usr/bin/strace", X_OK) != 0) throw std::runtime_error("SKIPPED: strace is not installed");
    const SshServer server;
    const PushedProject project;
    const std::string steps = "renameat,unlinkat,mkdirat,syncfs,fsync";
    bool was_old = false, was_new = false, is_over = false;
    for (int step = 1; !is_over; ++step) {
        CAPTURE(step);
        fs::remove_all(server.folder.path("home/robots"));
        fs::remove(server.folder.path("bin/nezumi"));
        project.folder.write("robots/behaviors/drive.lua", "-- first\n");
        project.folder.write("robots/behaviors/goes.lua", "-- first\n");
        REQUIRE(project.push(server).status == 0);
        fs::remove(project.folder.path("robots/behaviors/goes.lua"));
        project.folder.write("robots/behaviors/drive.lua", "-- second\n");
        server.receive_by("exec strace -qq -o /dev/null -e trace=" + steps + " -e inject=" + steps +
                          ":signal=KILL:when=" + std::to_string(step) + " " + nezumi_program() + " receive");
        is_over = project.push(server).status == 0;

        // As at the start of the robot's own run.
        const std::string file = server.folder.path("home/robots/behaviors/systems/one.lua").string();
        REQUIRE(run_nezumi({"receive", "--finish", file}).status == 0);
        const bool is_new = server.there("robots/behaviors/drive.lua") == "-- second\n";
        CHECK(server.there("robots/behaviors/goes.lua") == (is_new ? "not there" : "-- first\n"));
        (is_new ? was_new : was_old) = true;
        fs::remove(server.folder.path("bin/nezumi"));
        REQUIRE(project.push(server).status == 0);
        CHECK(server.there("robots/behaviors/drive.lua") == "-- second\n");
        CHECK(server.there("robots/behaviors/goes.lua") == "not there");
    }
    CHECK((was_old && was_new));
}

TEST_CASE("a run first finishes a push that was interrupted while its files were put in place", "[cli][push]") {
    if (access("/usr/bin/strace", X_OK) != 0) throw std::runtime_error("SKIPPED: strace is not installed");
    const SshServer server;
    const PushedProject project;
    REQUIRE(project.push(server).status == 0);
    project.folder.write("robots/behaviors/systems/one.lua", "the second one\n");
    server.receive_by("exec strace -qq -o /dev/null -e trace=renameat -e inject=renameat:signal=KILL:when=2 " +
                      nezumi_program() + " receive");
    CHECK(project.push(server).error ==
          "nezumi: mouse: the connection broke: push again: that finishes this push or undoes it\n");
    REQUIRE(server.there("robots/behaviors/systems/one.lua") != "the second one\n");
    fs::remove(server.folder.path("bin/nezumi"));
    const Outcome shown = project.push(server, {"--dry-run"});
    CHECK(shown.error ==
          "nezumi: mouse: a push to this folder was interrupted while its files were put in place: the next push "
          "finishes it\n");

    // One who may not write there is told what to do, and nothing runs.
    const std::string there = server.folder.path("home/robots").string();
    server.folder.write("home/robots/.nezumi-push/next", "half");
    const Outcome refused = run_nezumi({"run", "behaviors/systems/one.lua", "--headless"}, there);
    CHECK(refused.status == 2);
    CHECK(refused.error ==
          there +
              ": a push to this folder was interrupted and can't be finished (.nezumi-push/next: is damaged: remove it "
              "on the robot, then push again): push again, or run `nezumi receive --finish " +
              there + "` as the user who pushed it\n");
    fs::remove(server.folder.path("home/robots/.nezumi-push/next"));

    project.folder.write("robots/behaviors/systems/one.lua", "robot 'second' { model = 'raspimouse' }\n");
    server.receive_by("exec strace -qq -o /dev/null -e trace=renameat -e inject=renameat:signal=KILL:when=2 " +
                      nezumi_program() + " receive");
    CHECK(project.push(server).status == 2);
    const Outcome ran = run_nezumi({"run", "one", "--headless", "--duration", "0.01"}, there);
    CHECK(ran.status == 0);
    CHECK(server.there("robots/behaviors/systems/one.lua") == "robot 'second' { model = 'raspimouse' }\n");
}
