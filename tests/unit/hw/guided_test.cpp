// Sub-commands that drive a robot by themselves, over the fake mouse.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

TEST_CASE("the doctor turns each wheel both ways, and takes the motors' power", "[hw][run][fakes][wallclock]") {
    FakeMouse fake;
    const std::vector<std::string> words{"doctor", "--move", "--yes", "--dev-root", fake.dev()};
    const Outcome well = run_nezumi(words);
    CAPTURE(well.out, well.error);
    for (const char* what : {"left wheel forward: 0.0", "left wheel backward: -0.0", "right wheel forward: 0.0",
                             "right wheel backward: -0.0"})
        CHECK(well.out.find(std::string("ok     wheels: ") + what) != std::string::npos);
    CHECK_FALSE(fake.motion().power);
    const Pose2D pose = fake.truth();
    CHECK(std::hypot(pose.position.x, pose.position.y) < 0.02);

    fake.fault("rtcounter_r0", "eio");
    const Outcome broken = run_nezumi(words);
    CAPTURE(broken.out, broken.error);
    CHECK(broken.status == 1);
    CHECK(
        broken.out.find("wrong  wheels: right wheel forward: 0.000 m counted, 0.050 m expected\n       do: its counter "
                        "or its motor is not connected: look at their cables\n") != std::string::npos);
    CHECK_FALSE(fake.motion().power);
}

TEST_CASE("a robot's wheels are calibrated over its devices, and the file is used", "[hw][run][fakes][wallclock]") {
    FakeMouse fake;
    const std::string folder = fake.folder.path("").string();
    fake.folder.write("system.lua", "robot 'mouse' { model = 'raspimouse' }");
    const std::string answers = fake.folder.path("answers").string();
    REQUIRE(mkfifo(answers.c_str(), 0600) == 0);
    const int person = open(answers.c_str(), O_RDWR | O_CLOEXEC);
    REQUIRE(person >= 0);
    Program program({"calibrate", "odometry", "system.lua", "--yes", "--side", "0.15", "--dev-root", fake.dev()},
                    folder, answers);
    Pose2D start = fake.truth();
    for (int drive = 0; drive < 3; ++drive) {
        REQUIRE(program.wait_for_error("Where does it stand now: x y [m]: ", 60));
        program.error.clear();
        const Pose2D now = fake.truth();
        const double dx = now.position.x - start.position.x, dy = now.position.y - start.position.y;
        const double c = std::cos(start.heading), s = std::sin(start.heading);
        const std::string line = std::to_string(c * dx + s * dy) + " " + std::to_string(c * dy - s * dx) + "\n";
        REQUIRE(write(person, line.data(), line.size()) == static_cast<ssize_t>(line.size()));
        start = now;
    }
    const int status = program.wait();
    close(person);
    CAPTURE(program.out, program.error);
    REQUIRE(status == 0);
    double track = 0;
    REQUIRE(std::sscanf(program.out.c_str(), "track %lf m", &track) == 1);
    CHECK(track == Approx(0.0925).epsilon(0.03));
    CHECK_FALSE(fake.motion().power);
    CHECK(program.out.find("mouse.calibration.lua is used by nezumi run --hw\n") != std::string::npos);
    REQUIRE(std::filesystem::exists(fake.folder.path("mouse.calibration.lua")));
    fake.folder.write("simulated.lua", "robot 'mouse' { model = 'raspimouse', calibrated = true }");
    CHECK(run_nezumi({"check", "simulated.lua"}, folder).status == 0);
}
