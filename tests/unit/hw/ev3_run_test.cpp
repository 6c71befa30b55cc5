// `nezumi run --hw` of shipped systems on the fake EV3: events that end or stall the program, and the time until the
// wheels stand.
#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/hw/fake_ev3_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

std::string shipped(const std::string& system) { return source_root() + "/behaviors/systems/" + system + ".lua"; }

std::vector<std::string> words_for(const FakeEv3& fake, const std::string& file) {
    return {"run", file, "--hw=ev3", "--headless", "--dev-root", fake.roots().dev, "--sys-root", fake.roots().sys};
}

// The program drives the fake EV3, from standstill to a steady 0.2 m/s.
struct Ev3Run {
    Ev3Run() {
        fake.folder.write("behaviors/ahead.lua",
                          "local out = output('out', 'TimedVelocity2D', 'velocity')\n"
                          "function on_execute() out:write { vx = 0.2 } end\n");
        fake.folder.write("system.lua",
                          "robot 'ev3' { model = 'ev3' }\nbehavior 'driver' { script = 'ahead' }\n"
                          "connect('driver.out', 'ev3.velocity2D')\n");
        program.emplace(words_for(fake, "system.lua"), fake.folder.path("").string());
        INFO(program->error);
        REQUIRE(FakeEv3::wait_until([&] { return fake.motion().left > 400; }, 20));
        sleep_for(0.1);
    }
    ~Ev3Run() {
        fake.say("heal");
        program.reset();
    }
    Ev3Run(const Ev3Run&) = delete;
    Ev3Run& operator=(const Ev3Run&) = delete;

    // The time [s] from `cause` until the wheels stand.
    double time_to_stand(const std::function<void()>& cause) {
        const double begin = clock_seconds();
        cause();
        REQUIRE(FakeEv3::wait_until([&] { return !fake.moves(); }, 3));
        return fake.motion().still_since - begin;
    }
    pid_t guard() const {
        const std::string process = std::to_string(program->process());
        std::ifstream children("/proc/" + process + "/task/" + process + "/children");
        pid_t child = 0;
        children >> child;
        return child;
    }

    FakeEv3 fake;
    std::optional<Program> program;
};

}  // namespace

TEST_CASE("an EV3's wheels stand within 50 ms of the program's death", "[hw][ev3][run][fakes][safety][wallclock]") {
    const int signal = GENERATE(SIGTERM, SIGKILL, SIGSEGV);
    Ev3Run run;
    const double time = run.time_to_stand([&] { run.program->send(signal); });
    CHECK(time < 0.05);
    WARN("stopped " << time * 1e3 << " ms after signal " << signal);
}

TEST_CASE("an EV3's wheels stand within 250 ms of a stall, and when engine and guard die at the same time",
          "[hw][ev3][run][fakes][safety][wallclock]") {
    const bool is_stall = GENERATE(true, false);
    Ev3Run run;
    const pid_t guard = run.guard();
    REQUIRE(guard > 0);
    const double time = run.time_to_stand([&] {
        if (!is_stall) kill(guard, SIGKILL);
        run.program->send(is_stall ? SIGSTOP : SIGKILL);
    });
    CHECK(time < 0.25);
    WARN("stopped " << time * 1e3 << " ms after " << (is_stall ? "SIGSTOP" : "SIGKILL of both"));
    if (!is_stall) return;
    run.program->send(SIGCONT);
    CHECK(FakeEv3::wait_until([&] { return run.fake.moves(); }, 3));
}

TEST_CASE("an EV3's motors that were plugged in again, under other numbers, stand within 50 ms of the program's death",
          "[hw][ev3][run][fakes][safety][wallclock]") {
    Ev3Run run;
    for (const char* port : {"outB", "outC"}) {
        REQUIRE(run.fake.say(std::string("unplug ") + port).empty());
        REQUIRE(run.fake.say(std::string("plug ") + port).empty());
    }
    REQUIRE(FakeEv3::wait_until([&] { return run.fake.motion().left > 400 && run.fake.motion().right > 400; }, 5));
    sleep_for(0.1);
    CHECK(run.time_to_stand([&] { run.program->send(SIGKILL); }) < 0.05);
}

TEST_CASE("a run of an EV3 that is ended by Ctrl-C brakes, and lets its wheels roll",
          "[hw][ev3][run][fakes][wallclock]") {
    Ev3Run run;
    const double time = run.time_to_stand([&] { run.program->send(SIGINT); });
    CHECK(time > 0.1);
    CHECK(time < 0.2 / 1.0 + 0.2);
    CHECK(run.program->wait() == 0);
    CHECK(run.fake.motion().rolls);
}

TEST_CASE("when a person rolls the real EV3, the simulated mouse of the shipped system follows",
          "[hw][ev3][run][fakes][wallclock]") {
    FakeEv3 fake;
    auto words = words_for(fake, shipped("leader_follower"));
    const std::string recording = fake.folder.path("mouse.csv").string();
    for (const char* more : {"--duration", "3", "--ports", "mouse.truth.pose.position.x", "--record"})
        words.emplace_back(more);
    words.push_back(recording);
    Program program(words, source_root());
    REQUIRE(FakeEv3::wait_until(
        [&] {
            const auto writes = fake.writes();
            return std::count(writes.begin(), writes.end(), "outC/command 'stop'") > 0;
        },
        20));
    fake.say("disturb 0.1 - 0");
    const int status = program.wait();
    INFO(program.error);
    REQUIRE(status == 0);
    std::ifstream file(recording);
    std::string row;
    for (std::string line; std::getline(file, line);) row = line;
    INFO(row);
    CHECK(fake.truth().position.x > 0.1);
    CHECK(std::stod(row.substr(row.rfind(',') + 1)) > 0.05);
}

TEST_CASE("a shipped system is refused on an EV3 without a wheel's motor, and nothing moves",
          "[hw][ev3][run][fakes][safety][wallclock]") {
    FakeEv3 fake;
    fake.say("unplug outC");
    const Outcome outcome = run_nezumi(words_for(fake, shipped("touch_drive")), source_root());
    CHECK(outcome.status == 2);
    CHECK(outcome.error.find("motors: nothing is plugged in at outC, expected a lego-ev3-l-motor: look at its cable") !=
          std::string::npos);
    CHECK(fake.writes().empty());
}
