// Goldens: traces that are written once, committed, and compared within a tolerance.
#include <catch2/catch.hpp>

#include "tests/unit/file_text.hpp"
#include "tests/unit/scenario/scenario_rig.hpp"

using namespace nezumi;

namespace {

constexpr const char* drive =
    "scenario('it', function(s)\n"
    "  s:load 'systems/stop_at_wall.lua'\n"
    "  s:golden('it.csv', { tolerance = 1e-6 }, 'mouse.current_pose_out', 'mouse.ir_sensor_out')\n"
    "  s:run(0.1)\n"
    "end)\n";

// The rig with a golden that has been written.
void write_golden(ScenarioRig& rig) {
    rig.options.update_goldens = true;
    REQUIRE(outcome_of(rig.run()) == "passed");
    rig.options.update_goldens = false;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("a missing golden fails, and the message says how to write it", "[lua][scenario][golden]") {
    ScenarioRig rig(drive);
    CHECK(outcome_of(rig.run()).starts_with("failed: it_test.lua:3: golden 'it.csv': "));
    CHECK(outcome_of(rig.run()).ends_with("; nezumi test --update-goldens writes it"));
}

TEST_CASE("a run matches the golden that it wrote", "[lua][scenario][golden]") {
    ScenarioRig rig(drive);
    write_golden(rig);
    CHECK(outcome_of(rig.run()) == "passed");
    const std::string text = text_of_file(rig.folder().path("it.csv"));
    CHECK(
        text.starts_with("time,mouse.current_pose_out.position.x,mouse.current_pose_out.position.y,"
                         "mouse.current_pose_out.heading,mouse.ir_sensor_out[1],"));
    CHECK(std::count(text.begin(), text.end(), '\n') == 11);
}

TEST_CASE("a golden outside of the project is refused", "[lua][scenario][golden]") {
    for (const char* name : {"../it.csv", "link/it.csv"}) {
        ScenarioRig rig(replaced(drive, "it.csv", name));
        std::filesystem::create_directory_symlink(rig.folder().path().parent_path(), rig.folder().path("link"));
        const auto outside = rig.folder().path().parent_path() / "it.csv";
        for (const bool update : {true, false}) {
            rig.options.update_goldens = update;
            CHECK_THAT(outcome_of(rig.run()),
                       Catch::EndsWith("it_test.lua:3: golden: '" + std::string(name) +
                                       "' lies outside of the project: a golden must be saved in " +
                                       rig.folder().path().string() + " or below"));
            CHECK_FALSE(std::filesystem::exists(outside));
        }
    }
}

TEST_CASE("each run of a sweep has its own golden", "[lua][scenario][golden]") {
    ScenarioRig rig(
        "scenario('it', { sweep = { speed = { 0.1, 0.2 }, way = { 'a/b' } } }, function(s, p)\n"
        "  local w = s:load 'systems/stop_at_wall.lua' w.controller.config.speed_x = p.speed\n"
        "  s:golden('out/it.csv', 'controller.out')\n"
        "  s:run(0.1)\n"
        "end)\n");
    std::filesystem::create_directory(rig.folder().path("out"));
    rig.options.update_goldens = true;
    CHECK(rig.session().status() == 0);
    rig.options.update_goldens = false;
    CHECK(rig.session().status() == 0);
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(rig.folder().path("out")))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    REQUIRE(names.size() == 2);
    CHECK(names[0].starts_with("it-speed=0.1-way=a-b-"));  // and a number, since a sign was replaced
    CHECK(names[1].starts_with("it-speed=0.2-way=a-b-"));
    static_cast<void>(rig.folder().write("out/" + names[1], text_of_file(rig.folder().path("out/" + names[0]))));
    CHECK(rig.session().status() == 1);
    CHECK(rig.said.find("golden 'out/" + names[1] + "': line ") != std::string::npos);
}

TEST_CASE("a value outside of the tolerance is reported with line and time", "[lua][scenario][golden]") {
    ScenarioRig rig(drive);
    write_golden(rig);
    const std::string text = text_of_file(rig.folder().path("it.csv"));
    static_cast<void>(rig.folder().write("it.csv", replaced(text, "\n0.01,0,0,0", "\n0.01,0,0.0000005,0")));
    CHECK(outcome_of(rig.run()) == "passed");
    static_cast<void>(rig.folder().write("it.csv", replaced(text, "\n0.01,0,0,0", "\n0.01,0,0.5,0")));
    CHECK(outcome_of(rig.run()) ==
          "failed: it_test.lua:3: golden 'it.csv': line 2, at 0.01 s: mouse.current_pose_out.position.y is 0, off 0.5 "
          "by 0.5, more than the tolerance of 1e-06");
    static_cast<void>(
        rig.folder().write("it.csv", replaced(text, "\n0.01,0,0,0", "\n0.01,0,0.5" + std::string(3000, '0') + ",0")));
    CHECK(outcome_of(rig.run()).size() < 300);
    static_cast<void>(rig.folder().write("it.csv", replaced(text, "\n0.01,0,0,0", "\n0.01,0,,0")));
    CHECK(outcome_of(rig.run()) ==
          "failed: it_test.lua:3: golden 'it.csv': line 2, at 0.01 s: mouse.current_pose_out.position.y is 0, not "
          "nothing");
}

TEST_CASE("a golden with another length or other ports differs", "[lua][scenario][golden]") {
    ScenarioRig rig(drive);
    write_golden(rig);
    const std::string text = text_of_file(rig.folder().path("it.csv"));
    static_cast<void>(rig.folder().write("it.csv", text.substr(0, text.rfind('\n', text.size() - 2) + 1)));
    CHECK(outcome_of(rig.run()) == "failed: it_test.lua:3: golden 'it.csv': the run has 10 rows, the file 9");
    static_cast<void>(rig.folder().write("it.csv", replaced(text, "position.y", "position.z")));
    CHECK(outcome_of(rig.run()) ==
          "failed: it_test.lua:3: golden 'it.csv': the file has no column 'mouse.current_pose_out.position.y'");
    static_cast<void>(rig.folder().write("it.csv", ""));
    CHECK(outcome_of(rig.run()) == "failed: it_test.lua:3: golden 'it.csv': the file is empty");
}

TEST_CASE("the content of a golden's file is shown as short, printable text", "[lua][scenario][golden]") {
    ScenarioRig rig(drive);
    write_golden(rig);
    const std::string text = text_of_file(rig.folder().path("it.csv"));
    static_cast<void>(rig.folder().write("it.csv", replaced(text, "time,", "time\x1b[31m,")));
    CHECK(outcome_of(rig.run()) ==
          "failed: it_test.lua:3: golden 'it.csv': the run has no column 'time\\x1b[31m', which the file has");
    static_cast<void>(
        rig.folder().write("it.csv", replaced(text, "\n0.01,0,", "\n0.01," + std::string(5000, 'x') + ",")));
    CHECK(outcome_of(rig.run()).size() < 300);
}

TEST_CASE("a golden has every message of a tick", "[lua][scenario][golden]") {
    ScenarioRig rig(
        "scenario('it', function(s)\n"
        "  s:behavior('teller', { script = 'teller' })\n"
        "  s:golden('it.csv', {}, 'teller.out')\n"
        "  s:run(0.02)\n"
        "end)\n");
    static_cast<void>(rig.folder().write("behaviors/teller.lua",
                                         "local out = output('out', 'TimedString', 'words')\n"
                                         "function on_execute() out:write('one,') out:write('two\\n') end\n"));
    write_golden(rig);
    CHECK(outcome_of(rig.run()) == "passed");
    const std::string said = "\"one,\"\n", more = "\"two\n\"\n";
    CHECK(text_of_file(rig.folder().path("it.csv")) ==
          "time,teller.out\n0.01," + said + "0.01," + more + "0.02," + said + "0.02," + more);
}

TEST_CASE("a golden belongs to one line of a run, or to several runs with the same values", "[lua][scenario][golden]") {
    ScenarioRig twice(
        "scenario('it', function(s)\n"
        "  s:load 'systems/stop_at_wall.lua'\n"
        "  s:golden('it.csv', 'controller.out')\n"
        "  s:golden('./it.csv', 'mouse.current_pose_out')\n"
        "end)\n");
    twice.options.update_goldens = true;
    CHECK(outcome_of(twice.run()) ==
          "could not run: it_test.lua:4: golden: './it.csv' is already used by the golden at it_test.lua:3: choose "
          "another "
          "name");

    ScenarioRig both(
        "scenario('one', function(s)\n"
        "  s:load 'systems/stop_at_wall.lua' s:golden('it.csv', 'controller.out') s:run(0.1)\n"
        "end)\n"
        "scenario('two', function(s)\n"
        "  s:load 'systems/stop_at_wall.lua' s:golden('it.csv', 'mouse.current_pose_out') s:run(0.1)\n"
        "end)\n");
    const std::string path = both.folder().path("it_test.lua").string();
    both.options.update_goldens = true;
    const SessionEnd end = both.session();
    CHECK(end.status() == 2);
    REQUIRE(end.reports.size() == 2);
    CHECK(describe(end.reports.back().result.error) ==
          path + ":5: golden 'it.csv': one, " + path +
              ":2, has already written other values to this file: choose another name");
    CHECK_FALSE(end.measured.back().passed);
    CHECK(both.session("one").summary.could_not_run == 0);

    ScenarioRig alike(
        "scenario('one', function(s)\n"
        "  s:load 'systems/stop_at_wall.lua' s:golden('it.csv', 'controller.out') s:run(0.1)\n"
        "end)\n"
        "scenario('two', function(s)\n"
        "  s:load 'systems/stop_at_wall.lua' s:golden('it.csv', 'controller.out') s:run(0.1)\n"
        "end)\n");
    for (const bool update : {true, false}) {
        alike.options.update_goldens = update;
        alike.options.repeat = update ? 1 : 2;
        CHECK(alike.session().status() == 0);
    }
}
