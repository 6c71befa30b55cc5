// A robot that has a first version of a project, and the second version that is to come.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <string>

#include "tests/unit/push/traced_robot.hpp"

namespace nezumi::push {

struct SecondPush {
    SecondPush() {
        namespace fs = std::filesystem;
        for (const std::string name :
             {"behaviors/stays.lua", "behaviors/changes.lua", "goes/one.lua", "goes/two.lua", "turns"})
            robot.scratch.write("robots/" + name, "first " + name);
        fs::create_symlink("behaviors", robot.project() / "way");
        REQUIRE(robot.push().sent);
        robot.scratch.write("home/robots/run.mcap", "recorded");
        old_tree = tree_of(robot.there());

        fs::remove_all(robot.project() / "goes");
        fs::remove(robot.project() / "turns");
        fs::remove(robot.project() / "way");
        fs::create_symlink("lib", robot.project() / "way");
        robot.scratch.write("robots/behaviors/changes.lua", "second");
        robot.scratch.write("robots/turns/into a folder", "second");
        robot.scratch.write("robots/lib/-new\nname", "second");
        new_tree = tree_of(robot.project());
        new_tree["run.mcap"] = "recorded";  // what the robot wrote stays
    }
    TracedRobot robot;
    std::map<std::string, std::string> old_tree, new_tree;
};

}  // namespace nezumi::push
