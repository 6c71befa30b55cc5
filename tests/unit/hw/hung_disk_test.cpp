// `nezumi run --hw` with output files on a hanging disk.
#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <set>

#include "engine/base/whole_file.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

// A driving robot whose run writes all possible files.
struct WritingRun {
    WritingRun() {
        fake.folder.write("behaviors/ahead.lua",
                          "local out = output('out', 'TimedVelocity2D', 'velocity')\n"
                          "function on_execute() out:write { vx = 0.15 } end\n");
        fake.folder.write("system.lua",
                          "robot 'mouse' { model = 'raspimouse' }\nbehavior 'driver' { script = 'ahead' }\n"
                          "connect('driver.out', 'mouse.target_velocity_in')\n");
        program.emplace(std::vector<std::string>{"run", "system.lua", "--hw", "--headless", "--dev-root", fake.dev(),
                                                 "--record", on_disk("run.csv"), "--journal", on_disk("acts"),
                                                 "--device-log", on_disk("devices.log")},
                        fake.folder.path("").string());
        INFO(program->error);
        REQUIRE(FakeMouse::wait_until([&] { return fake.motion().left > 390; }, 20));
        sleep_for(0.3);
    }
    // A program that writes to a hanging disk does not end.
    ~WritingRun() {
        disk.say("heal");
        program.reset();
    }
    WritingRun(const WritingRun&) = delete;
    WritingRun& operator=(const WritingRun&) = delete;

    std::string on_disk(const std::string& file) const { return disk.mount() + "/" + file; }
    // Whether the wheels stand within so many seconds.
    bool stands_within(double seconds) {
        return FakeMouse::wait_until([&] { return !fake.moves(); }, seconds);
    }

    FakeMouse fake;
    FakeRobot disk{"fake_disk", ""};
    std::optional<Program> program;
};

}  // namespace

TEST_CASE("a hanging disk does not stop a robot, and Ctrl-C still stops it", "[hw][run][fakes][safety][wallclock]") {
    WritingRun run;
    REQUIRE(run.disk.say("hang").empty());
    // After two seconds all three writers wait.
    for (int i = 0; i < 100; ++i) {
        REQUIRE(run.fake.moves());
        sleep_for(0.02);
    }
    run.program->send(SIGINT);
    CHECK(run.stands_within(0.15 / 0.52 + 0.2));
    // The writers still wait, and the motors have no power meanwhile.
    CHECK(FakeMouse::wait_until([&] { return !run.fake.motion().power; }, 1));
    REQUIRE(run.disk.say("heal").empty());
    CHECK(run.program->wait() == 0);
    INFO(run.program->error);
    for (const char* file : {"run.csv", "acts", "devices.log"}) {
        const std::string text = *read_whole(run.on_disk(file), file);
        INFO(file);
        CHECK(text.ends_with('\n'));
        CHECK(std::count(text.begin(), text.end(), '\n') > 2);
        CHECK_FALSE(std::filesystem::exists(run.on_disk(file) + "~"));
    }
}

TEST_CASE("with a hanging disk the first Ctrl-C stops the robot and the second ends the run",
          "[hw][run][fakes][safety][wallclock]") {
    WritingRun run;
    REQUIRE(run.disk.say("hang").empty());
    sleep_for(0.5);
    run.program->send(SIGINT);
    CHECK(run.stands_within(0.15 / 0.52 + 0.2));
    run.program->send(SIGINT);
    CHECK(FakeMouse::wait_until([&] { return !run.fake.motion().power; }, 1));
    REQUIRE(run.disk.say("heal").empty());  // a system call ends with its answer
    run.program->wait();
    CHECK_FALSE(run.fake.moves());
}
