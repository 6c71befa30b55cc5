// What a push replaces, removes and keeps: the rows of the table in docs/hardware.md.
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/unit/push/traced_robot.hpp"

using namespace nezumi;
using namespace nezumi::push;

namespace {

namespace fs = std::filesystem;
using What = FileChange::What;
using Changes = std::vector<FileChange>;
using Files = std::map<std::string, std::string>;

// A robot to which `behaviors/drive.lua` and `lib/old.lua` were pushed.
struct RobotWithProject : TracedRobot {
    RobotWithProject() {
        scratch.write("robots/behaviors/drive.lua", "first");
        scratch.write("robots/lib/old.lua", "first");
        REQUIRE(push().sent);
    }
    void write_here(const std::string& name, const std::string& text) const { scratch.write("robots/" + name, text); }
    void write_there(const std::string& name, const std::string& text) const {
        scratch.write("home/robots/" + name, text);
    }
    void remove_here(const std::string& name) const { fs::remove_all(project() / name); }
    Changes push_changes() const {
        const auto shown = push("robots", true).sent;
        const auto sent = push().sent;
        REQUIRE(shown);
        REQUIRE(sent);
        CHECK(sent->changes == shown->changes);
        return sent->changes;
    }
};

}  // namespace

TEST_CASE("a file with the pushed content is replaced, or removed with its folder", "[push][kept]") {
    const RobotWithProject robot;
    robot.write_here("behaviors/drive.lua", "second");
    robot.remove_here("lib");
    CHECK(robot.push_changes() == Changes{{What::changed, "behaviors/drive.lua"}, {What::removed, "lib/old.lua"}});
    CHECK(tree_of(robot.there()) == Files{{"behaviors", "/"}, {"behaviors/drive.lua", "second"}});
    CHECK(robot.push_changes().empty());
}

TEST_CASE("a file edited on the robot is kept and reported at each push, until both are equal", "[push][kept]") {
    const RobotWithProject robot;
    robot.write_there("behaviors/drive.lua", "edited");
    for (const std::string here : {"first", "second", "third"}) {
        CAPTURE(here);
        robot.write_here("behaviors/drive.lua", here);
        CHECK(robot.push_changes() == Changes{{What::kept_edited, "behaviors/drive.lua"}});
        CHECK(tree_of(robot.there()).at("behaviors/drive.lua") == "edited");
    }
    robot.write_there("behaviors/drive.lua", "first");  // undone there: it is as pushed again
    CHECK(robot.push_changes() == Changes{{What::changed, "behaviors/drive.lua"}});
}

TEST_CASE("a file edited on the robot and removed from the project becomes the robot's own", "[push][kept]") {
    const RobotWithProject robot;
    robot.write_there("lib/old.lua", "edited");
    robot.remove_here("lib");
    CHECK(robot.push_changes() == Changes{{What::kept_removed, "lib/old.lua"}});
    CHECK(robot.push_changes().empty());
    robot.write_here("lib/old.lua", "second");
    CHECK(robot.push_changes() == Changes{{What::kept_own, "lib/old.lua"}});
    CHECK(tree_of(robot.there()).at("lib/old.lua") == "edited");
}

TEST_CASE("recordings, logs and calibrations of the robot stay, also if their folder is removed from the project",
          "[push][kept]") {
    const RobotWithProject robot;
    robot.write_there("lib/run.mcap", "recorded");
    robot.write_there("mouse.log", "log");
    robot.write_there("behaviors/mouse.calibration.lua", "its own");
    robot.write_here("behaviors/mouse.calibration.lua", "ours");
    robot.remove_here("lib");
    CHECK(robot.push_changes() == Changes{{What::removed, "lib/old.lua"}});
    CHECK(tree_of(robot.there()) == Files{{"behaviors", "/"},
                                          {"behaviors/drive.lua", "first"},
                                          {"behaviors/mouse.calibration.lua", "its own"},
                                          {"lib", "/"},
                                          {"lib/run.mcap", "recorded"},
                                          {"mouse.log", "log"}});
}

TEST_CASE("a file removed on the robot is pushed again", "[push][kept]") {
    const RobotWithProject robot;
    fs::remove_all(robot.there() / "lib");
    CHECK(robot.push_changes() == Changes{{What::added, "lib"}, {What::added, "lib/old.lua"}});
}

TEST_CASE("a link or file in place of a folder on the robot is kept, and nothing is written through it",
          "[push][kept]") {
    const RobotWithProject robot;
    robot.scratch.write("home/elsewhere/old.lua", "first");
    fs::remove_all(robot.there() / "lib");
    fs::create_directory_symlink("../elsewhere", robot.there() / "lib");
    robot.write_here("lib/old.lua", "second");
    CHECK(robot.push_changes() == Changes{{What::kept_edited, "lib"}});
    robot.remove_here("lib/old.lua");
    CHECK(robot.push_changes() == Changes{{What::kept_edited, "lib"}});
    robot.remove_here("lib");
    CHECK(robot.push_changes() == Changes{{What::kept_removed, "lib"}});
    CHECK(tree_of(robot.home() / "elsewhere") == Files{{"old.lua", "first"}});
    CHECK(tree_of(robot.there()).at("lib") == "-> ../elsewhere");
}

TEST_CASE("a file may replace a folder and a folder a file, unless the robot has its own files there", "[push][kept]") {
    const RobotWithProject robot;
    robot.remove_here("lib");
    robot.write_here("lib", "a file now");
    robot.write_there("lib/run.mcap", "recorded");
    CHECK(robot.push_changes() == Changes{{What::kept_edited, "lib"}, {What::removed, "lib/old.lua"}});
    fs::remove(robot.there() / "lib/run.mcap");
    CHECK(robot.push_changes() == Changes{{What::changed, "lib"}});
    CHECK(tree_of(robot.there()).at("lib") == "a file now");
    robot.remove_here("lib");
    robot.write_here("lib/deep/new.lua", "second");
    robot.push_changes();
    CHECK(tree_of(robot.there()) == tree_of(robot.project()));
}

TEST_CASE("executable files are executable on the robot", "[push][kept]") {
    const RobotWithProject robot;
    fs::permissions(robot.project() / "lib/old.lua", fs::perms::owner_all);
    CHECK(robot.push_changes() == Changes{{What::changed, "lib/old.lua"}});
    CHECK(access((robot.there() / "lib/old.lua").c_str(), X_OK) == 0);
    CHECK(robot.push_changes().empty());
}

TEST_CASE("FIFOs, git's files and editors' copies are not pushed", "[push][kept]") {
    const RobotWithProject robot;
    for (const char* name :
         {".git/config", "deep/.git", "build/x", "drive.lua~", ".drive.lua.swp", ".nezumi-push/list"})
        robot.write_here(name, "not for the robot");
    robot.write_here("deep/build/x", "for the robot");
    REQUIRE(mkfifo((robot.project() / "pipe").c_str(), 0600) == 0);
    const auto scan = scan_project(robot.project());
    REQUIRE(scan);
    CHECK(scan->passed_over == std::vector<std::string>{"pipe"});
    CHECK(robot.push_changes() ==
          Changes{{What::added, "deep"}, {What::added, "deep/build"}, {What::added, "deep/build/x"}});
}

TEST_CASE("if a file changes while it is sent, the robot is unchanged", "[push][kept]") {
    const RobotWithProject robot;
    const auto before = tree_of(robot.there());
    robot.write_here("behaviors/drive.lua", "second");
    bool has_changed = false;
    const auto sent =
        robot
            .push_cut({.watch =
                           [&](const DiskCall&, bool) {
                               if (!has_changed)
                                   robot.write_here("behaviors/drive.lua", "third");  // after the list was made
                               has_changed = true;
                           }})
            .sent;
    REQUIRE_FALSE(sent);
    CHECK(sent.error().message ==
          "behaviors/drive.lua: changed while it was sent: push again: nothing was changed on the robot");
    CHECK(tree_of(robot.there()) == before);
}

TEST_CASE("of two pushes to one folder at a time the second is refused", "[push][kept]") {
    const RobotWithProject robot;
    robot.write_here("behaviors/drive.lua", "second");
    std::string second;
    const auto sent =
        robot
            .push_cut({.watch =
                           [&](const DiskCall& call, bool) {
                               if (!second.empty() || call.path.find("/.nezumi-push/new") == std::string::npos) return;
                               const auto other = robot.push().sent;
                               second = other ? "done" : other.error().message;
                           }})
            .sent;
    CHECK(sent);
    CHECK(second.ends_with("another push to this folder is running: wait until it ends"));
}
