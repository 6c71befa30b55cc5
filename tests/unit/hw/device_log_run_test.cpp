// `nezumi run --device-log` on the fake mouse, and the replay of the log without it.
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>

#include "engine/base/whole_file.hpp"
#include "hw/log/device_log.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"
#include "tests/unit/hw/rover_run.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

void write_system(const Scratch& folder, const std::string& speed) {
    folder.write("behaviors/ahead.lua",
                 "local out = output('out', 'TimedVelocity2D', 'velocity')\n"
                 "function on_execute() out:write { vx = now() > 1 and " +
                     speed + " or 0 } end\n");
    folder.write("system.lua",
                 "robot 'mouse' { model = 'raspimouse' }\nbehavior 'driver' { script = 'ahead' }\n"
                 "connect('driver.out', 'mouse.target_velocity_in')\n");
}

Outcome play(const Scratch& folder) {
    return run_nezumi({"run", "system.lua", "--hw", "--headless", "--device-log-play", "x.log"},
                      folder.path("").string());
}

}  // namespace

TEST_CASE("a logged run replays without the robot, and differences of its behaviour are reported",
          "[hw][log][run][fakes][wallclock]") {
    const Scratch folder;
    {
        FakeMouse fake;
        write_system(folder, "0.15");
        const Outcome run = run_nezumi({"run", "system.lua", "--hw", "--headless", "--dev-root", fake.dev(),
                                        "--duration", "3", "--device-log", "x.log"},
                                       folder.path("").string());
        CAPTURE(run.error);
        REQUIRE(run.status == 0);
        REQUIRE(fake.truth().position.x > 0.1);
    }
    const Outcome same = play(folder);
    CAPTURE(same.error);
    CHECK(same.status == 0);
    CHECK(same.error.find("x.log: replayed, ") != std::string::npos);
    CHECK(same.error.find(" writes were equal\n") != std::string::npos);

    write_system(folder, "0.05");
    const Outcome slower = play(folder);
    CAPTURE(slower.error);
    CHECK(slower.status == 1);
    CHECK(slower.error.find("' was written to /dev/rtmotor_raw_l0, but now it has '") != std::string::npos);
    CHECK(slower.error.find("x.log: replayed, ") != std::string::npos);
    CHECK(slower.error.find(" difference") != std::string::npos);
}

TEST_CASE("the device log of a killed program has whole lines and can be replayed",
          "[hw][log][run][fakes][wallclock]") {
    const Scratch folder;
    {
        FakeMouse fake;
        write_system(folder, "0.15");
        Program program({"run", "system.lua", "--hw", "--headless", "--dev-root", fake.dev(), "--device-log", "x.log"},
                        folder.path("").string());
        REQUIRE(FakeMouse::wait_until([&] { return fake.motion().left > 390; }, 20));
        sleep_for(0.3);
        program.send(SIGKILL);
        program.wait();
    }
    const auto log = read_device_log(*read_whole(folder.path("x.log"), "x.log"), "x.log");
    REQUIRE(log);
    CHECK_FALSE(log->is_torn);
    CHECK(log->length > 1);
    CHECK(log->calls.size() > 100);
    const Outcome outcome = play(folder);
    CAPTURE(outcome.error);
    CHECK(outcome.status == 0);
}

TEST_CASE("a device log that can no longer be written is reported once, and the run continues",
          "[hw][log][run][fakes][wallclock]") {
    FakeMouse fake;
    write_system(fake.folder, "0.15");
    const Outcome run = run_nezumi({"run", "system.lua", "--hw", "--headless", "--dev-root", fake.dev(), "--duration",
                                    "2.5", "--device-log", "/dev/full"},
                                   fake.folder.path("").string());
    CAPTURE(run.error);
    CHECK(run.status == 0);
    CHECK(fake.truth().position.x > 0.1);
    const std::string told =
        "/dev/full: the device log can't be written: No space left on device: the run continues without it\n";
    const auto first = run.error.find(told);
    CHECK(first != std::string::npos);
    CHECK(run.error.find(told, first + 1) == std::string::npos);
}

TEST_CASE("a file that is not a device log is refused before anything runs", "[hw][log][run]") {
    const Scratch folder;
    write_system(folder, "0.15");
    folder.write("x.log", "nezumi device log 1\n0.1 0 peek /dev/x = 1\n");
    const Outcome wrong = play(folder);
    CHECK(wrong.status == 2);
    CHECK(wrong.error == "x.log:2: expected open-read, open-write, read, write, list or keys, got 'peek'\n");
    std::filesystem::remove(folder.path("x.log"));
    CHECK(play(folder).error == "x.log: there is no such file\n");
}

TEST_CASE("a device log has no messages of a serial line: its replay is refused, and nothing is opened",
          "[hw][wire][log][run][wallclock]") {
    RoverRun run;
    run.start({"--duration", "1", "--device-log", run.folder.path("x.log").string()});
    REQUIRE(run.program->wait() == 0);
    REQUIRE(run.rover->last_line() == "v 0 0");
    std::size_t before = 0;
    do {  // the guard may still send its safe bytes
        before = run.rover->lines().size();
        usleep(300000);
    } while (run.rover->lines().size() != before);
    const Outcome outcome = play(run.folder);
    CHECK(outcome.status == 2);
    CHECK(outcome.error.ends_with(
        "component 'rover_line': can't replay this device: a device log has no messages of Serial, Udp, I2c, Spi and "
        "Gpio\n"));
    CHECK(std::count(outcome.error.begin(), outcome.error.end(), '\n') == 1);
    CHECK(run.rover->lines().size() == before);
}
