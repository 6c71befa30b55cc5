// `nezumi run --hw` on the fake mouse: events that end or stall the program, and the time until the wheels stand.
#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "engine/base/whole_file.hpp"
#include "tests/unit/hw/hardware_run.hpp"

using namespace nezumi;
using namespace nezumi::hw;

TEST_CASE("the wheels stand within 50 ms of the program's death", "[hw][run][fakes][safety][wallclock]") {
    const int signal = GENERATE(SIGTERM, SIGKILL, SIGSEGV, SIGABRT);
    HardwareRun run;
    run.get_going();
    const double time = run.time_to_stand([&] { run.program->send(signal); });
    INFO("signal " << signal);
    CHECK(time < 0.05);
    CHECK(FakeMouse::wait_until([&] { return !run.fake.motion().power; }, 1));
    WARN("stopped " << time * 1e3 << " ms after signal " << signal);
}

TEST_CASE("the wheels stand within 50 ms of the guard's death, and the run says so",
          "[hw][run][fakes][safety][wallclock]") {
    const int signal = GENERATE(SIGTERM, SIGKILL, SIGSEGV);
    HardwareRun run;
    run.get_going();
    REQUIRE(run.guard() > 0);
    const double time = run.time_to_stand([&] { kill(run.guard(), signal); });
    CHECK(time < 0.05);
    CHECK(run.program->wait_for_error("guard of the motors: its process has ended", 5));
    sleep_for(0.3);
    CHECK_FALSE(run.fake.moves());
    CHECK_FALSE(run.fake.motion().power);
    WARN("stopped " << time * 1e3 << " ms after signal " << signal << " to the guard");
}

TEST_CASE("the wheels stand within 250 ms of a stall of program or guard, and turn again after it",
          "[hw][run][fakes][safety][wallclock]") {
    HardwareRun run;
    run.get_going();
    const bool is_guard = GENERATE(false, true);
    const pid_t process = is_guard ? run.guard() : run.program->process();
    const double time = run.time_to_stand([&] { kill(process, SIGSTOP); });
    CHECK(time < 0.25);
    kill(process, SIGCONT);
    CHECK(run.program->wait_for_error("guard of the motors: ", 5));
    CHECK(FakeMouse::wait_until([&] { return run.fake.moves(); }, 3));
    WARN("stopped " << time * 1e3 << " ms after SIGSTOP" << (is_guard ? " of the guard" : ""));
}

TEST_CASE("a motor's node that hangs does not keep the robot driving", "[hw][run][fakes][safety][wallclock]") {
    HardwareRun run("fails_at_2_s = true");
    run.get_going();
    run.fake.fault("rtmotor_raw_r0", "hang");  // the first write after that is the braking
    REQUIRE(run.program->wait_for_error("no luck", 10));
    CHECK(run.time_to_stand([] {}) < 0.25);
}

TEST_CASE("the wheels stand within 250 ms of a script's endless loop", "[hw][run][fakes][safety][wallclock]") {
    HardwareRun run;
    run.get_going();
    const double time = run.time_to_stand([&] { run.fake.say("button 2 1"); });
    constexpr double reading = 0.04;  // longest reading of the button
    CHECK(time < reading + 0.25);
    CHECK(run.program->wait_for_error("ran for more than 0.1 s: is there an endless loop?", 5));
    WARN("stopped " << time * 1e3 << " ms after the button that starts the loop was pressed");
}

TEST_CASE("Ctrl-C brakes and switches the motors off", "[hw][run][fakes][wallclock]") {
    HardwareRun run;
    run.get_going();
    const double time = run.time_to_stand([&] { run.program->send(SIGINT); });
    CHECK(time > 0.15);
    CHECK(time < 0.15 / 0.52 + 0.2);
    CHECK(run.program->wait() == 0);
    CHECK_FALSE(run.fake.motion().power);
}

TEST_CASE("SIGTERM stops all motion and leaves complete files", "[hw][run][fakes][safety][wallclock]") {
    HardwareRun run("", "raspimouse", {"--record", "run.csv", "--ports", "driver.out.vx", "--journal", "acts"});
    run.get_going();
    run.program->send(SIGTERM);
    REQUIRE(run.program->wait() == 0);
    INFO(run.program->error);
    CHECK_FALSE(run.fake.moves());
    CHECK_FALSE(run.fake.motion().power);
    const std::string rows = *read_whole(run.fake.folder.path("run.csv").string(), "run.csv");
    CHECK(std::count(rows.begin(), rows.end(), '\n') > 20);
    CHECK(rows.ends_with('\n'));
    CHECK_FALSE(std::filesystem::exists(run.fake.folder.path("acts~")));
    const std::string acts = *read_whole(run.fake.folder.path("acts").string(), "acts");
    CHECK(acts.find("\"end\"") != acts.npos);
}

TEST_CASE("SIGTERM stops a guided robot at once", "[hw][run][fakes][safety][wallclock]") {
    FakeMouse fake;
    fake.folder.write("system.lua", "robot 'mouse' { model = 'raspimouse' }");
    Program program({"calibrate", "odometry", "system.lua", "--yes", "--dev-root", fake.dev()},
                    fake.folder.path("").string());
    REQUIRE(FakeMouse::wait_until([&] { return fake.motion().left > 200; }, 20));
    const double begin = clock_seconds();
    program.send(SIGTERM);
    REQUIRE(FakeMouse::wait_until([&] { return !fake.moves(); }, 3));
    CHECK(fake.motion().still_since - begin < 0.05);
    CHECK(program.wait() == 2);
    CHECK(program.error.ends_with("interrupted: the robot has stopped\n"));
    CHECK_FALSE(fake.motion().power);
}

TEST_CASE("a second program on the same mouse is refused, and the first drives on",
          "[hw][run][fakes][safety][wallclock]") {
    HardwareRun run;
    run.get_going();
    const Outcome second = run_nezumi({"run", "system.lua", "--hw", "--headless", "--dev-root", run.fake.dev()},
                                      run.fake.folder.path("").string());
    CHECK(second.status == 2);
    CHECK(second.error.find("another program (process ") != std::string::npos);
    CHECK(second.error.find(") drives this robot's motors: end it first, then try again") != std::string::npos);
    sleep_for(0.1);
    CHECK(run.fake.moves());
}

TEST_CASE("nothing moves before the start button is pressed", "[hw][run][fakes][safety][wallclock]") {
    HardwareRun run("", "waiting_mouse");
    REQUIRE(run.program->wait_for_error("mouse WAITS: PRESS switch0 ON THE ROBOT", 20));
    sleep_for(0.5);
    CHECK_FALSE(run.fake.moves());
    run.fake.say("button 0 1");
    CHECK(run.program->wait_for_error("mouse starts", 5));
    run.fake.say("button 0 0");
    run.get_going();
}

TEST_CASE("the journal of a run on hardware has its acts, but can't be replayed", "[hw][run][fakes][wallclock]") {
    HardwareRun run("", "raspimouse", {"--duration", "1", "--journal", "acts"});
    REQUIRE(run.program->wait() == 0);
    const Outcome again = run_nezumi({"run", "system.lua", "--replay", "acts"}, run.fake.folder.path("").string());
    CHECK(again.status == 2);
    CHECK(again.error ==
          "nezumi: acts is the journal of a run on hardware: it is only a record, and can't be replayed\n");
}

TEST_CASE("a long press of the mouse's button ends the run, and then shuts the computer down",
          "[hw][run][fakes][safety][wallclock]") {
    const Scratch programs;
    const auto asked = programs.path("words");
    chmod(programs.write("systemctl", "#!/bin/sh\necho \"$*\" > " + asked.string() + "\n").c_str(), 0755);
    const std::string path = std::getenv("PATH");
    setenv("PATH", (programs.path("").string() + ":" + path).c_str(), 1);
    HardwareRun run("", "shutdown_mouse");
    setenv("PATH", path.c_str(), 1);
    run.get_going();
    run.fake.say("button 1 1");
    sleep_for(1);
    run.fake.say("button 1 0");  // a short press does nothing
    sleep_for(2.5);
    CHECK(run.fake.moves());
    CHECK_FALSE(std::filesystem::exists(asked));
    run.fake.say("button 1 1");
    CHECK(run.program->wait_for_error("mouse: switch1 was held for 3 s: the run ends, and the computer is shut down",
                                      10));
    CHECK(run.program->wait() == 0);
    CHECK_FALSE(run.fake.motion().power);
    std::string word;
    std::ifstream(asked) >> word;
    CHECK(word == "poweroff");
}

TEST_CASE("a real mouse with a sensor for neighbours sees and tells nothing, says so once, and drives",
          "[hw][run][fakes][wallclock]") {
    FakeMouse fake;
    fake.folder.write("behaviors/ahead.lua", behavior_ahead);
    fake.folder.write("system.lua", R"(
robot "mouse" {
  model = "raspimouse",
  sensors = { near = { kind = "neighbours", radius = 1 } },
  ports = { near = { type = "NeighbourSeq", from = "near" }, say = { type = "TimedDoubleSeq", to = "say" } },
}
behavior "driver" { script = "ahead" }
connect("driver.out", "mouse.target_velocity_in")
)");
    const Outcome run = run_nezumi({"run", "system.lua", "--hw", "--headless", "--dev-root", fake.dev(), "--duration",
                                    "2", "--record", "run.csv", "--ports", "mouse.near,driver.out.vx"},
                                   fake.folder.path("").string());
    INFO(run.error);
    CHECK(run.status == 0);
    CHECK(fake.truth().position.x > 0.05);
    const std::string told =
        "neighbours and what they say exist only in simulation: this real robot sees none and says nothing\n";
    const auto first = run.error.find(told);
    CHECK(first != std::string::npos);
    CHECK(run.error.find(told, first + 1) == std::string::npos);
    const std::string rows = *read_whole(fake.folder.path("run.csv").string(), "run.csv");
    CHECK(rows.starts_with("time,driver.out.vx\n"));
}
