// Which folders of a robot a project may go to.
#include "bindings/push/destination.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/unit/push/traced_robot.hpp"

using namespace nezumi;
using namespace nezumi::push;

namespace {

namespace fs = std::filesystem;

// What a push to this folder says in place of pushing; "" when it is done.
std::string refusal(const TracedRobot& robot, const std::string& folder) {
    const auto sent = robot.push(folder).sent;
    return sent ? "" : describe(sent.error());
}

const std::string own = ": choose a folder for this project only, for example --to robots";

struct RobotWithFiles : TracedRobot {
    RobotWithFiles() {
        scratch.write("home/.ssh/authorized_keys", "keys");
        scratch.write("home/Documents/letter", "dear");
        scratch.write("robots/behaviors/drive.lua", "first");
        fs::create_directory_symlink(".", home() / "here");
        fs::create_directory_symlink("/", home() / "slash");
        fs::create_directory_symlink("Documents", home() / "papers");
        before = tree_of(home());
    }
    std::map<std::string, std::string> before;
};

}  // namespace

TEST_CASE("a home folder is refused by any of its paths", "[push][destination]") {
    const RobotWithFiles robot;
    const std::string whole = robot.home().string();
    for (const std::string& name :
         std::vector<std::string>{".", "./", "~", "~/", "~/.", "Documents/..", "new/..", "here", "here/", "here/here/.",
                                  "papers/..", whole, whole + "//"}) {
        CAPTURE(name);
        CHECK(refusal(robot, name) == shown(name) + " is a home folder" + own);
    }
    CHECK(refusal(robot, "/root") == "/root is a home folder" + own);
    CHECK(tree_of(robot.home()) == robot.before);
}

TEST_CASE("the root folder and a folder above a home are refused by any of their paths", "[push][destination]") {
    const RobotWithFiles robot;
    for (const std::string name : {"/", "//", "slash", "slash/", "/.", "slash/tmp/.."}) {
        CAPTURE(name);
        CHECK(refusal(robot, name) == shown(name) + " is the root folder" + own);
    }
    for (const std::string& name : std::vector<std::string>{"..", "~/..", robot.scratch.path("").string()}) {
        CAPTURE(name);
        CHECK(refusal(robot, name) ==
              shown(name) + " contains the home folder " + shown(fs::canonical(robot.home()).string()) + own);
    }
    CHECK(tree_of(robot.home()) == robot.before);
}

TEST_CASE("a folder that has files and was not pushed to before is refused by any of its paths",
          "[push][destination]") {
    const RobotWithFiles robot;
    for (const std::string name :
         {"Documents", "Documents/", "./Documents", "papers", "~/Documents", "here/Documents"}) {
        CAPTURE(name);
        CHECK(refusal(robot, name) == name +
                                          " has files and was not pushed to before: choose another folder with --to, "
                                          "or move it away on the robot");
    }
    CHECK(refusal(robot, "Documents/letter") == "Documents/letter: Not a directory");
    CHECK(refusal(robot, "~pi") == "~pi: expected / after ~; for a folder with this name write ./~pi");
    CHECK(tree_of(robot.home()) == robot.before);
}

TEST_CASE("a folder with the name of the push's own does not prove an earlier push", "[push][destination]") {
    const RobotWithFiles robot;
    fs::create_directory(robot.home() / "Documents/.nezumi-push");
    CHECK(refusal(robot, "Documents").find("was not pushed to before") != std::string::npos);
    fs::create_directory(robot.home() / "trap");
    fs::create_directory_symlink("../Documents", robot.home() / "trap/.nezumi-push");
    CHECK(refusal(robot, "trap").find("Not a directory") != std::string::npos);
    CHECK(tree_of(robot.home() / "Documents") == std::map<std::string, std::string>{{"letter", "dear"}});
}

TEST_CASE("a folder that is new, empty or pushed to before is accepted by any of its paths", "[push][destination]") {
    const RobotWithFiles robot;
    fs::create_directory(robot.home() / "empty");
    for (const char* name : {"demo", "demo/", "./demo/.", "~/demo", "here/demo//", "Documents/../demo", "empty/",
                             "empty", "deep/er", "-rf", "a b", "it's \"new\"\n", ":x", "./~x"}) {
        CAPTURE(name);
        CHECK(refusal(robot, name).empty());
    }
    for (const char* name : {"demo", "empty", "deep/er", "-rf", "a b", "it's \"new\"\n", ":x", "~x"}) {
        CAPTURE(name);
        CHECK(tree_of(robot.home() / name) == tree_of(robot.project()));
    }
    for (const auto& [name, content] : robot.before) CHECK(tree_of(robot.home()).at(name) == content);
}

TEST_CASE("a folder pushed to by an older nezumi is recognised by its copy", "[push][destination]") {
    const TracedRobot robot;
    for (const char* folder : {"home/robots/", "home/robots.coming/"}) {
        robot.scratch.write(std::string(folder) + "behaviors/drive.lua", "first");
        robot.scratch.write(std::string(folder) + "behaviors/goes.lua", "first");
        robot.scratch.write(std::string(folder) + "behaviors/edited.lua", "first");
    }
    robot.scratch.write("home/robots/behaviors/edited.lua", "on the robot");
    robot.scratch.write("home/robots/run.mcap", "recorded");
    robot.scratch.write("robots/behaviors/drive.lua", "second");
    robot.scratch.write("robots/behaviors/edited.lua", "second");
    const auto copy = tree_of(robot.home() / "robots.coming");
    // A first push that is cut leaves this way open.
    CHECK_FALSE(robot.push_cut({.at = 3}).sent);
    const auto sent = robot.push().sent;
    REQUIRE(sent);
    CHECK(sent->changes == std::vector<FileChange>{{FileChange::What::changed, "behaviors/drive.lua"},
                                                   {FileChange::What::kept_edited, "behaviors/edited.lua"},
                                                   {FileChange::What::removed, "behaviors/goes.lua"}});
    CHECK(sent->copy_before == fs::canonical(robot.home()).string() + "/robots.coming");
    CHECK(tree_of(robot.there()) == std::map<std::string, std::string>{{"behaviors", "/"},
                                                                       {"behaviors/drive.lua", "second"},
                                                                       {"behaviors/edited.lua", "on the robot"},
                                                                       {"run.mcap", "recorded"}});
    CHECK(tree_of(robot.home() / "robots.coming") == copy);
    CHECK(robot.push().sent->copy_before.empty());
}
