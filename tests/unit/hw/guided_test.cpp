// Sub-commands that drive a robot by themselves, over the fake mouse.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/hw/fake_ev3_rig.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

TEST_CASE("the doctor turns each wheel both ways, then switches the motors off", "[hw][run][fakes][wallclock]") {
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
    CHECK(broken.out.find("wrong  wheels: right wheel forward: 0.000 m counted, 0.050 m expected\n       do: the "
                          "wheel's counter or motor is not connected: check the cables of both\n") !=
          std::string::npos);
    CHECK_FALSE(fake.motion().power);
}

TEST_CASE("the doctor turns each wheel of an EV3 both ways, then releases them", "[hw][ev3][run][fakes][wallclock]") {
    FakeEv3 fake;
    const std::vector<std::string> words{"doctor",         "--move",     "--yes",         "--dev-root",
                                         fake.roots().dev, "--sys-root", fake.roots().sys};
    const Outcome well = run_nezumi(words);
    CAPTURE(well.out, well.error);
    for (const char* what : {"left wheel forward: 0.0", "left wheel backward: -0.0", "right wheel forward: 0.0",
                             "right wheel backward: -0.0"})
        CHECK(well.out.find(std::string("ok     wheels: ") + what) != std::string::npos);
    CHECK(fake.motion().rolls);
    CHECK_FALSE(fake.moves());

    REQUIRE(fake.say("unplug outB").empty());
    const Outcome broken = run_nezumi(words);
    CAPTURE(broken.out, broken.error);
    CHECK(broken.status == 2);
    CHECK(broken.error.find("motors: nothing is plugged in at outB, expected a lego-ev3-l-motor: look at its cable") !=
          std::string::npos);
    CHECK_FALSE(fake.moves());
}

namespace {

// A person who measures exactly: answers with the robot's position in the frame of the drive's start.
class Measurer {
public:
    explicit Measurer(FakeRobot& fake) : fake_(fake), answers_(fake.folder.path("answers").string()) {
        REQUIRE(mkfifo(answers_.c_str(), 0600) == 0);
        file_ = open(answers_.c_str(), O_RDWR | O_CLOEXEC);
        REQUIRE(file_ >= 0);
        start_ = fake.truth();
    }
    ~Measurer() { close(file_); }
    Measurer(const Measurer&) = delete;
    Measurer& operator=(const Measurer&) = delete;

    const std::string& answers() const { return answers_; }
    void serve(Program& program) {
        for (int drive = 0; drive < 3; ++drive) {
            REQUIRE(program.wait_for_error("Where is the robot now: x y [m]: ", 60));
            program.error.clear();
            const Pose2D now = fake_.truth();
            const double dx = now.position.x - start_.position.x, dy = now.position.y - start_.position.y;
            const double c = std::cos(start_.heading), s = std::sin(start_.heading);
            const std::string line = std::to_string(c * dx + s * dy) + " " + std::to_string(c * dy - s * dx) + "\n";
            REQUIRE(write(file_, line.data(), line.size()) == static_cast<ssize_t>(line.size()));
            start_ = now;
        }
    }

private:
    FakeRobot& fake_;
    const std::string answers_;
    int file_ = -1;
    Pose2D start_;
};

}  // namespace

TEST_CASE("a robot's wheels are calibrated over its devices, and the file is used", "[hw][run][fakes][wallclock]") {
    FakeMouse fake;
    const std::string folder = fake.folder.path("").string();
    fake.folder.write("system.lua", "robot 'mouse' { model = 'raspimouse' }");
    Measurer person(fake);
    Program program({"calibrate", "odometry", "system.lua", "--yes", "--side", "0.15", "--dev-root", fake.dev()},
                    folder, person.answers());
    person.serve(program);
    const int status = program.wait();
    CAPTURE(program.out, program.error);
    REQUIRE(status == 0);
    double track = 0;
    REQUIRE(std::sscanf(program.out.c_str(), "track %lf m", &track) == 1);
    CHECK(track == Approx(0.0925).epsilon(0.03));
    CHECK_FALSE(fake.motion().power);
    CHECK(program.out.find("mouse.calibration.lua: nezumi run --hw uses this file from now on\n") != std::string::npos);
    REQUIRE(std::filesystem::exists(fake.folder.path("mouse.calibration.lua")));
    fake.folder.write("simulated.lua", "robot 'mouse' { model = 'raspimouse', calibrated = true }");
    CHECK(run_nezumi({"check", "simulated.lua"}, folder).status == 0);
}

TEST_CASE("an EV3's wheels are calibrated over its devices", "[hw][ev3][run][fakes][wallclock]") {
    FakeEv3 fake;
    const std::string folder = fake.folder.path("").string();
    fake.folder.write("system.lua", "robot 'ev3' { model = 'ev3' }");
    Measurer person(fake);
    Program program({"calibrate", "odometry", "system.lua", "--yes", "--side", "0.2", "--dev-root", fake.roots().dev,
                     "--sys-root", fake.roots().sys},
                    folder, person.answers());
    person.serve(program);
    const int status = program.wait();
    CAPTURE(program.out, program.error);
    REQUIRE(status == 0);
    double track = 0, left = 0, right = 0;
    REQUIRE(std::sscanf(program.out.c_str(), "track %lf m, left radius %lf m, right radius %lf m", &track, &left,
                        &right) == 3);
    CHECK(track == Approx(0.108).epsilon(0.03));
    CHECK(left == Approx(0.028).epsilon(0.03));
    CHECK(right == Approx(0.028).epsilon(0.03));
    CHECK_FALSE(fake.moves());
    CHECK(program.out.find("ev3.calibration.lua: nezumi run --hw uses this file from now on\n") != std::string::npos);
}
