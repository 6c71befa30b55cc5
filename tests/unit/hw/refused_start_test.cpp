// `nezumi run --hw` without usable motors: one line with the reason, exit status 2, and no motion.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/hw/fake_ev3_rig.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

Outcome run_on(const Scratch& folder, const std::string& model, const DeviceRoots& roots) {
    folder.write("system.lua", "robot 'one' { model = '" + model + "' }");
    return run_nezumi({"run", "system.lua", "--hw", "--headless", "--duration", "1", "--dev-root", roots.dev,
                       "--sys-root", roots.sys},
                      folder.path("").string());
}

}  // namespace

TEST_CASE("without permission for the mouse's nodes, nothing moves and the error says what to do",
          "[hw][mouse][fakes][safety]") {
    const std::string node = GENERATE("rtmotor_raw_l0", "rtmotor_raw_r0", "rtmotoren0");
    FakeMouse fake;
    fake.fault(node, "denied");
    const Outcome outcome = run_on(fake.folder, "raspimouse", fake.roots());
    CHECK(outcome.status == 2);
    CHECK(outcome.error ==
          "system.lua:1: motors: " + fake.dev() + "/" + node +
              ": permission denied: this user has no permission to use it. Try: sudo chmod a+rw /dev/rt*, or write "
              "a udev rule for it\n");
    CHECK(fake.writes().empty());
}

TEST_CASE("without permission for an EV3's motor, nothing moves and the error says what to do",
          "[hw][ev3][fakes][safety]") {
    const std::string node = GENERATE("outB/command", "outC/speed_sp");
    FakeEv3 fake;
    fake.fault(node, "denied");
    const Outcome outcome = run_on(fake.folder, "ev3", fake.roots());
    CHECK(outcome.status == 2);
    CHECK(std::count(outcome.error.begin(), outcome.error.end(), '\n') == 1);
    CHECK(outcome.error.starts_with("system.lua:1: motors: " + fake.roots().sys + "/class/tacho-motor/motor"));
    CHECK(outcome.error.ends_with(
        node.substr(node.find('/')) +
        ": permission denied: this user has no permission to use it. Try: sudo adduser $USER ev3dev\n"));
    CHECK(fake.writes().empty());
    CHECK_FALSE(fake.moves());
}

TEST_CASE("a folder in place of a motor's node is refused as a folder, and nothing is written", "[hw][mouse][safety]") {
    const std::string wrong = GENERATE("rtmotor_raw_l0", "rtmotor_raw_r0", "rtmotoren0");
    const Scratch folder;
    for (const std::string node : {"rtmotoren0", "rtmotor_raw_l0", "rtmotor_raw_r0"}) {
        if (node == wrong) {
            std::filesystem::create_directories(folder.path("dev/" + node));
        } else {
            folder.write("dev/" + node, "untouched");
        }
    }
    const std::string dev = folder.path("dev").string();
    const Outcome outcome = run_on(folder, "raspimouse", {.dev = dev, .sys = folder.path("sys").string()});
    CHECK(outcome.status == 2);
    CHECK(outcome.error ==
          "system.lua:1: motors: " + dev + "/" + wrong + ": is a directory and no device: is --dev-root right?\n");
    for (const std::string node : {"rtmotoren0", "rtmotor_raw_l0", "rtmotor_raw_r0"}) {
        if (node == wrong) continue;
        std::string text;
        std::ifstream(folder.path("dev/" + node)) >> text;
        CHECK(text == "untouched");
    }
}

TEST_CASE("a wrong motor for an EV3's wheel is refused by its name, and nothing moves", "[hw][ev3][fakes][safety]") {
    FakeEv3 fake;
    fake.folder.write("behaviors/turned.lua",
                      "return robot_model { base = 'ev3', drive = { port = { 'outA', 'outC' } }, "
                      "actuators = { medium_motor = { port = 'outB' } } }");
    const Outcome outcome = run_on(fake.folder, "turned", fake.roots());
    CHECK(outcome.status == 2);
    CHECK(outcome.error ==
          "system.lua:1: motors: a lego-ev3-m-motor is plugged in at outA, expected a lego-ev3-l-motor: change their "
          "cables, or set port = ... in the robot file\n");
    CHECK(fake.writes().empty());
}
