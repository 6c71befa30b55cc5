// `nezumi doctor`: what it prints, and how it ends.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

Outcome doctor(const Scratch& machine, std::vector<std::string> more = {}) {
    std::vector<std::string> words{"doctor",
                                   "--dev-root",
                                   machine.path("dev").string(),
                                   "--sys-root",
                                   machine.path("sys").string(),
                                   "--proc-root",
                                   machine.path("proc").string(),
                                   "--udev-root",
                                   machine.path("udev").string()};
    words.insert(words.end(), more.begin(), more.end());
    return run_nezumi(words);
}

void write_mouse(const Scratch& machine) {
    for (const char* node : {"rtmotoren0", "rtmotor_raw_l0", "rtmotor_raw_r0", "rtled0", "rtled1", "rtled2", "rtled3",
                             "rtbuzzer0", "rtcounter_l0", "rtcounter_r0", "rtswitch0", "rtswitch1", "rtswitch2"})
        machine.write(std::string("dev/") + node, "0\n");
    machine.write("dev/rtlightsensor0", "1 2 3 4\n");
    machine.write("sys/module/rtmouse/version", "3.3.2\n");
}

}  // namespace

TEST_CASE("the doctor ends with 0 where nothing is to be done", "[cli][doctor]") {
    const Scratch machine;
    write_mouse(machine);
    const Outcome outcome = doctor(machine);
    CHECK(outcome.status == 0);
    CHECK(outcome.out.starts_with("ok     driver: rtmouse 3.3.2\nok     nodes: all 14 can be used\n"));
    CHECK(outcome.out.find("note   udev rules: no udev rule gives access to the device nodes: other users have no "
                           "access, or lose it at the next start\n       do: sudo cp ") != std::string::npos);
    CHECK(outcome.out.ends_with("\nnothing wrong\n"));
}

TEST_CASE("the doctor ends with 1 and says what to do", "[cli][doctor]") {
    const Scratch machine;
    write_mouse(machine);
    std::filesystem::remove_all(machine.path("sys"));
    machine.write("sys/firmware/devicetree/base/model", "Raspberry Pi 5 Model B");
    std::filesystem::remove(machine.path("dev/rtled2"));
    const Outcome outcome = doctor(machine);
    CHECK(outcome.status == 1);
    CHECK(outcome.out.find("wrong  nodes: 1 of 14 are missing in ") != std::string::npos);
    CHECK(outcome.out.find(": rtled2\n       do: load the driver again") != std::string::npos);
    CHECK(outcome.out.ends_with("\n2 things to do\n"));
}

TEST_CASE("the doctor writes the same findings as JSON for programs", "[cli][doctor]") {
    const Scratch machine;
    write_mouse(machine);
    machine.write("dev/rtlightsensor0", "0 0 0 0\n");
    const Outcome outcome = doctor(machine, {"--json"});
    CHECK(outcome.status == 1);
    const auto all = nlohmann::json::parse(outcome.out);
    CHECK(all.at("robot") == "raspimouse");
    CHECK(all.at("findings").at(0) ==
          nlohmann::json{{"check", "driver"}, {"state", "ok"}, {"found", "rtmouse 3.3.2"}, {"advice", ""}});
    int wrong = 0;
    for (const auto& finding : all.at("findings")) wrong += finding.at("state") == "wrong" ? 1 : 0;
    CHECK(wrong == 2);  // the zeros, and the overlay that they lead to
}

TEST_CASE("no wheel turns unless somebody is there to see it", "[cli][doctor][safety]") {
    const Scratch machine;
    write_mouse(machine);
    const Outcome outcome = doctor(machine, {"--move"});
    CHECK(outcome.status == 2);
    CHECK(outcome.error ==
          "nezumi: a person must stand beside the robot: run this command in a terminal, or add --yes\n");
    const Scratch nothing;
    const Outcome no_robot = doctor(nothing, {"--move", "--yes"});
    CHECK(no_robot.status == 2);
    CHECK(no_robot.error == "nezumi: --move: no robot was found on this machine\n");
}
