// A driving mouse whose nodes are changed: it can still be stopped, or it stands.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <string>

#include "tests/unit/hw/hardware_run.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

const std::vector<std::string> motor_nodes{"rtmotoren0", "rtmotor_raw_l0", "rtmotor_raw_r0"};

// The folder of nodes is replaced by an empty one, as if another /dev was mounted over it.
void hide_nodes(const HardwareRun& run) {
    std::filesystem::create_directory(run.fake.folder.path("empty"));
    std::filesystem::remove(run.dev());
    std::filesystem::create_directory_symlink(run.fake.folder.path("empty"), run.dev());
}

// True if any write since the log was cleared turns a motor or switches it on.
bool was_driven(FakeMouse& fake) {
    const auto writes = fake.writes();
    return std::any_of(writes.begin(), writes.end(), [](const std::string& write) {
        return write.starts_with("rtmotor") && !write.ends_with("'0'");
    });
}

}  // namespace

TEST_CASE("after any change of its nodes' paths, the mouse stands within 50 ms of the program's death",
          "[hw][run][fakes][safety][wallclock]") {
    HardwareRun run;
    run.get_going();
    SECTION("permissions were taken") {
        for (const auto& node : motor_nodes) run.fake.fault(node, "denied");
    }
    SECTION("another folder is in their place") { hide_nodes(run); }
    sleep_for(0.4);
    REQUIRE(run.fake.moves());
    CHECK(run.time_to_stand([&] { run.program->send(SIGKILL); }) < 0.05);
    CHECK(FakeMouse::wait_until([&] { return !run.fake.motion().power; }, 1));
}

TEST_CASE("a mouse with a reloaded driver drives again, and its guard can stop it",
          "[hw][run][fakes][safety][wallclock]") {
    HardwareRun run;
    run.get_going();
    run.fake.say("reload");
    REQUIRE(FakeMouse::wait_until([&] { return run.fake.moves(); }, 5));
    run.get_going();
    for (const auto& node : motor_nodes) run.fake.fault(node, "denied");  // then by its own descriptors
    CHECK(run.time_to_stand([&] { run.program->send(SIGKILL); }) < 0.05);
}

TEST_CASE("a mouse whose motor power can't be written brakes and reports it within 0.3 s, without a new command",
          "[hw][run][fakes][safety][wallclock]") {
    HardwareRun run;
    run.get_going();
    const double begin = clock_seconds();
    run.fake.fault("rtmotoren0", "missing");
    CHECK(run.program->wait_for_error("motors: " + run.dev() + "/rtmotoren0: no such ", 5));
    CHECK(clock_seconds() - begin < 0.3);
    REQUIRE(FakeMouse::wait_until([&] { return !run.fake.moves(); }, 1));
    CHECK(run.fake.motion().still_since - begin < 0.3);
    run.fake.fault("rtmotoren0", "none");
    CHECK(FakeMouse::wait_until([&] { return run.fake.moves(); }, 5));
}

TEST_CASE("a second program is refused after a reload of the mouse's driver too",
          "[hw][run][fakes][safety][wallclock]") {
    HardwareRun run;
    run.get_going();
    run.fake.say("reload");
    const Outcome second = run_nezumi({"run", "system.lua", "--hw", "--headless", "--dev-root", run.fake.dev()},
                                      run.fake.folder.path("").string());
    CHECK(second.status == 2);
    CHECK(second.error.find("another program (process " + std::to_string(run.program->process()) +
                            ") drives this robot's motors: end it first, then try again") != std::string::npos);
}

TEST_CASE("a program that continues while its guard is suspended makes no driving write",
          "[hw][run][fakes][safety][wallclock]") {
    HardwareRun run;
    run.get_going();
    const pid_t guard = run.guard();
    kill(guard, SIGSTOP);
    run.program->send(SIGSTOP);
    sleep_for(0.4);
    REQUIRE(run.fake.moves());  // nothing could stop it
    run.fake.say("clear");
    const bool is_program_first = GENERATE(true, false);
    if (is_program_first) {
        const double time = run.time_to_stand([&] { run.program->send(SIGCONT); });
        CHECK(time < 0.05);
        sleep_for(0.3);
        CHECK_FALSE(was_driven(run.fake));
        kill(guard, SIGCONT);
    } else {
        CHECK(run.time_to_stand([&] { kill(guard, SIGCONT); }) < 0.05);
        CHECK_FALSE(was_driven(run.fake));
        run.program->send(SIGCONT);
    }
    CHECK(FakeMouse::wait_until([&] { return run.fake.moves(); }, 3));
    CHECK(run.program->wait_for_error("guard of the motors: ", 5));
}
