// `nezumi push` and `nezumi attach ssh:`, tried with a server of its own on the loopback.
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/unit/cli/ssh_server.hpp"

using namespace nezumi;
namespace fs = std::filesystem;

TEST_CASE("a project is copied, with changed and removed files, and the robot's calibration stays", "[cli][push]") {
    const SshServer server;
    const PushedProject project;
    const Outcome first = project.push(server);
    CAPTURE(first.error);
    REQUIRE(first.status == 0);
    CHECK(first.out == "robots is on mouse in robots\n");
    CHECK(server.there("robots/behaviors/drive.lua") == "-- first\n");
    CHECK(server.there("robots/.git/config") == "not there");

    server.folder.write("home/robots/behaviors/systems/mouse.calibration.lua", "its own");
    project.folder.write("robots/behaviors/drive.lua", "-- second\n");
    fs::remove(project.folder.path("robots/behaviors/systems/one.lua"));
    CHECK(project.push(server).status == 0);
    CHECK(server.there("robots/behaviors/drive.lua") == "-- second\n");
    CHECK(server.there("robots/behaviors/systems/one.lua") == "not there");
    CHECK(server.there("robots/behaviors/systems/mouse.calibration.lua") == "its own");
}

TEST_CASE("files that were edited on the robot, or were its own before, are kept and reported", "[cli][push]") {
    const SshServer server;
    const PushedProject project;
    project.folder.write("robots/behaviors/goes.lua", "-- first\n");
    REQUIRE(project.push(server).status == 0);
    server.folder.write("home/robots/behaviors/drive.lua", "-- edited\n");
    server.folder.write("home/robots/behaviors/goes.lua", "-- edited\n");
    server.folder.write("home/robots/behaviors/new\nline.lua", "-- its own\n");
    server.folder.write("home/robots/run.mcap", "recorded");
    project.folder.write("robots/behaviors/new\nline.lua", "-- another\n");
    project.folder.write("robots/behaviors/drive.lua", "-- second\n");
    project.folder.write("robots/behaviors/more.lua", "-- second\n");
    fs::remove(project.folder.path("robots/behaviors/goes.lua"));
    const std::string told =
        "nezumi: behaviors/drive.lua is kept on mouse: it was edited on the robot; copy it here or remove it there, "
        "then push "
        "again\n";
    const std::string told_own =
        "nezumi: \"behaviors/new\\nline.lua\" is kept on mouse: it did not come from a push; copy it here, or rename "
        "or "
        "remove it on the robot, then push again\n";
    const std::string told_removed =
        "nezumi: behaviors/goes.lua is kept on mouse: it was edited on the robot and is no longer in the project: "
        "push no longer manages it\n";

    const Outcome shown = project.push(server, {"--dry-run"});
    CHECK(shown.status == 1);
    CHECK(shown.out ==
          "kept     behaviors/drive.lua\nkept     behaviors/goes.lua\nnew      behaviors/more.lua\n"
          "kept     \"behaviors/new\\nline.lua\"\nnothing was changed on mouse\n");
    CHECK(shown.error == told + told_removed + told_own);
    CHECK(server.there("robots/behaviors/more.lua") == "not there");

    const Outcome pushed = project.push(server, {"--run", "behaviors/systems/one.lua"});
    CHECK(pushed.status == 2);
    CHECK(pushed.out == "robots is on mouse in robots, except for the files that were kept\n");
    CHECK(pushed.error ==
          told + told_removed + told_own +
              "nezumi: behaviors/systems/one.lua is not run, because mouse kept files that differ from the project\n");
    CHECK(server.there("robots/behaviors/drive.lua") == "-- edited\n");
    CHECK(server.there("robots/behaviors/goes.lua") == "-- edited\n");
    CHECK(server.there("robots/behaviors/new\nline.lua") == "-- its own\n");
    CHECK(server.there("robots/behaviors/more.lua") == "-- second\n");
    CHECK(server.there("robots/run.mcap") == "recorded");

    // Once the edit is in the project, it is as any other file.
    project.folder.write("robots/behaviors/drive.lua", "-- edited\n");
    fs::remove(server.folder.path("home/robots/behaviors/new\nline.lua"));
    CHECK(project.push(server).status == 0);
    project.folder.write("robots/behaviors/drive.lua", "-- third\n");
    CHECK(project.push(server).status == 0);
    CHECK(server.there("robots/behaviors/drive.lua") == "-- third\n");
    CHECK(server.there("robots/behaviors/goes.lua") == "-- edited\n");
}

TEST_CASE("a push with --dry-run shows what it would change, and changes nothing", "[cli][push]") {
    const SshServer server;
    const PushedProject project;
    const Outcome first = project.push(server, {"--dry-run"});
    CHECK(first.status == 0);
    CHECK(first.out ==
          "new      behaviors\nnew      behaviors/drive.lua\nnew      behaviors/systems\n"
          "new      behaviors/systems/one.lua\nnothing was changed on mouse\n");
    CHECK_FALSE(fs::exists(server.folder.path("home/robots")));
    REQUIRE(project.push(server).status == 0);
    project.folder.write("robots/behaviors/drive.lua", "-- second\n");
    fs::remove(project.folder.path("robots/behaviors/systems/one.lua"));
    CHECK(project.push(server, {"--dry-run"}).out ==
          "changed  behaviors/drive.lua\nremoved  behaviors/systems/one.lua\nnothing was changed on mouse\n");
    CHECK(server.there("robots/behaviors/drive.lua") == "-- first\n");
    CHECK(project.push(server, {"--dry-run", "--run", "x.lua"}).error ==
          "nezumi: --dry-run only shows what would change: leave out --run\n");
}

TEST_CASE("a folder there that a project would be mixed into is refused by ssh as well", "[cli][push]") {
    const SshServer server;
    const PushedProject project;
    server.folder.write("home/.ssh/authorized_keys", "keys");
    const std::string own = ": choose a folder for this project only, for example --to robots\n";
    for (const char* home : {".", "~", "~/", "./.", "/root", "x/.."}) {
        CAPTURE(home);
        const Outcome refused = project.push(server, {"--to", home});
        CHECK(refused.status == 2);
        CHECK(refused.error == "nezumi: mouse: " + std::string(home) + " is a home folder" + own);
    }
    CHECK(project.push(server, {"--to", "/"}).error == "nezumi: mouse: / is the root folder" + own);
    CHECK(project.push(server, {"--to", ".ssh/"}).error ==
          "nezumi: mouse: .ssh/ has files and was not pushed to before: choose another folder with --to, or move it "
          "away on the robot\n");
    CHECK(server.there(".ssh/authorized_keys") == "keys");
    REQUIRE(project.push(server, {"--to", "demo"}).status == 0);
    REQUIRE(project.push(server, {"--to", "demo/"}).status == 0);
    CHECK(server.there("demo/behaviors/drive.lua") == "-- first\n");
}

TEST_CASE("file names with special characters of shells or options are copied unchanged", "[cli][push]") {
    const SshServer server;
    const PushedProject project;
    const std::vector<std::string> names{"-rf", "--delete", ":x", "a b", "new\nline", "it's \"q\"", "$(touch x)", "*"};
    for (const std::string& name : names) project.folder.write("robots/behaviors/" + name + "/" + name, name);
    for (const std::string& folder : names) {
        CAPTURE(folder);
        const Outcome pushed = project.push(server, {"--to=" + folder});
        CHECK(pushed.error == "");
        for (const std::string& name : names) CHECK(server.there(folder + "/behaviors/" + name + "/" + name) == name);
    }
    CHECK_FALSE(fs::exists(server.folder.path("home/x")));
}

TEST_CASE("a robot with another version of nezumi, or none, gets nothing", "[cli][push]") {
    const SshServer server;
    const PushedProject project;
    server.write_program("nezumi", "echo nezumi 9.9.9\n");
    const Outcome other = project.push(server);
    CHECK(other.status == 2);
    CHECK(other.error.starts_with("nezumi: mouse has nezumi 9.9.9, this computer has nezumi "));
    CHECK(other.error.ends_with(": install the same version on both\n"));
    server.write_program("nezumi", "exit 127\n");
    CHECK(project.push(server).error == "nezumi: mouse needs nezumi: install its package there\n");
    CHECK(server.there("robots/behaviors/drive.lua") == "not there");
}

TEST_CASE("a file of the project is run there by its real robots, and its status is ours", "[cli][push]") {
    const SshServer server;
    const PushedProject project;
    server.write_program("nezumi",
                         "[ \"$1\" = run ] || exec " + nezumi_program() + " \"$@\"\npwd; echo \"$@\"; exit 1\n");
    const Outcome ran = project.push(server, {"--run", "behaviors/systems/one.lua", "--to", "a place"});
    CHECK(ran.status == 1);
    CHECK(ran.out == "robots is on mouse in a place\n" + fs::canonical(server.folder.path("home/a place")).string() +
                         "\nrun behaviors/systems/one.lua --hw\n");
}

TEST_CASE("a running robot uses the new behaviour as soon as a project is pushed, and keeps its state",
          "[cli][push][wallclock]") {
    const SshServer server;
    const PushedProject project;
    const auto script = [](const std::string& says) {
        return "state.ticks = state.ticks or 0\n"
               "function on_execute() state.ticks = state.ticks + 1\n"
               "  if state.ticks % 20 == 0 then print('" +
               says + " ' .. (state.ticks > 60 and 'late' or 'early')) end\nend\n";
    };
    project.folder.write("robots/behaviors/drive.lua", script("first"));
    project.folder.write("robots/behaviors/systems/one.lua", "behavior 'driver' { script = 'drive' }\n");
    REQUIRE(project.push(server).status == 0);
    Program robot({"run", "behaviors/systems/one.lua"}, server.folder.path("home/robots").string());
    REQUIRE(robot.wait_for_error("first late"));

    project.folder.write("robots/behaviors/drive.lua", script("second"));
    REQUIRE(project.push(server).status == 0);
    const auto pushed = std::chrono::steady_clock::now();
    REQUIRE(robot.wait_for_error("second "));
    CHECK(std::chrono::steady_clock::now() - pushed < std::chrono::seconds(2));
    CHECK(robot.error.find("second early") == std::string::npos);  // its state is kept

    project.folder.write("robots/behaviors/drive.lua", "function on_execute( end");
    REQUIRE(project.push(server).status == 0);
    REQUIRE(robot.wait_for_error("drive.lua:1: "));  // and goes on with the version before
    robot.error.clear();
    CHECK(robot.wait_for_error("second late"));
}

TEST_CASE("the console of a robot is reached by ssh", "[cli][push]") {
    const SshServer server;
    server.write_program("nezumi", "for word in \"$@\"; do echo \"[$word]\"; done\nexit 1\n");
    const Outcome outcome = run_nezumi(
        {"attach", "ssh:mouse/stop_at_wall", "--ssh-config", server.config(), "--eval", "print('it''s; $HOME')"});
    CHECK(outcome.status == 1);
    CHECK(outcome.out == "[attach]\n[stop_at_wall]\n[--eval]\n[print('it''s; $HOME')]\n");
    fs::remove(server.folder.path("bin/nezumi"));
    const Outcome listed = run_nezumi({"attach", "ssh:mouse", "--ssh-config", server.config(), "--list"});
    CHECK((listed.status == 0 || listed.error.find("nothing is running") != std::string::npos));
}

TEST_CASE("a malformed host is refused in one line", "[cli][push]") {
    const Scratch nothing;
    CHECK(run_nezumi({"push", "pi@mouse"}, nothing.path("").string()).error ==
          "nezumi: there is no project here: expected a folder behaviors/ here or in a folder above\n");
    CHECK(run_nezumi({"attach", "ssh:-oProxyCommand=x"}).error ==
          "nezumi: expected a user and a host as in pi@mouse, got '-oProxyCommand=x'\n");
    for (const char* host : {"pi mouse", "-oProxyCommand=y", "x@-oProxyCommand=y", "-x@mouse", "a@b@-y", "@mouse",
                             "pi@", "pi@mouse:robots", "ssh://mouse"}) {
        CAPTURE(host);
        CHECK(run_nezumi({"push", "--", host}).error ==
              "nezumi: expected a user and a host as in pi@mouse, got '" + std::string(host) + "'\n");
    }
    CHECK(
        run_nezumi({"push", "pi\nmouse"}).error.starts_with("nezumi: expected a user and a host as in pi@mouse, got "));
}
