// The guard process stops the motors when the engine ends or stalls for any reason.
#include "hw/guard/guard.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <functional>

#include "hw/device/clock.hpp"
#include "tests/unit/hw/guard_rig.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

// An engine in its own process, with a turning motor.
struct Engine {
    explicit Engine(const std::function<void(Guard&)>& live) {
        folder.write("power", "1");
        folder.write("motor", "400");
        int ready[2];
        REQUIRE(pipe(ready) == 0);
        process = fork();
        if (process == 0) {
            for (const int signal : {SIGTERM, SIGSEGV, SIGABRT, SIGINT}) std::signal(signal, SIG_DFL);  // not Catch's
            auto guard = Guard::start("test", folder.path("power").string());
            if (!guard || !guard_file(**guard, 0, folder.path("power")) ||
                !guard_file(**guard, 1, folder.path("motor")))
                _exit(1);
            (*guard)->beat(clock_seconds());
            const pid_t number = (*guard)->process();
            if (write(ready[1], &number, sizeof number) != sizeof number) _exit(1);
            live(**guard);
            _exit(0);
        }
        close(ready[1]);
        REQUIRE(read(ready[0], &guard_process, sizeof guard_process) == sizeof guard_process);
        close(ready[0]);
    }
    ~Engine() {
        kill(process, SIGKILL);
        waitpid(process, nullptr, 0);
    }
    bool stands() const {
        return guarded_text(folder.path("power")) == "0" && guarded_text(folder.path("motor")) == "0";
    }
    // How long until it stands [s]; at most a second.
    double time_to_stand() const {
        const double begin = clock_seconds();
        while (!stands() && clock_seconds() - begin < 1) guard_sleep(0.0005);
        return clock_seconds() - begin;
    }

    Scratch folder;
    pid_t process = 0;
    pid_t guard_process = 0;
};

void beat_for_ever(Guard& guard) {
    for (;;) {
        guard.beat(clock_seconds());
        guard.has_stopped();
        guard_sleep(0.01);
    }
}

}  // namespace

TEST_CASE("the motors stand within 50 ms of their engine's death", "[hw][guard][safety][wallclock]") {
    for (const int signal : {SIGTERM, SIGKILL, SIGSEGV, SIGABRT}) {
        INFO("signal " << signal);
        const Engine engine(beat_for_ever);
        guard_sleep(0.3);
        REQUIRE_FALSE(engine.stands());
        kill(engine.process, signal);
        CHECK(engine.time_to_stand() < 0.05);
    }
}

TEST_CASE("the motors stand as soon even if another process keeps the dead engine's files open",
          "[hw][guard][safety][wallclock]") {
    // Like a thread that waits in the kernel for a device.
    const Engine engine([](Guard& guard) {
        if (fork() == 0) {
            guard_sleep(1.5);
            _exit(0);
        }
        beat_for_ever(guard);
    });
    guard_sleep(0.3);
    REQUIRE_FALSE(engine.stands());
    kill(engine.process, SIGKILL);
    CHECK(engine.time_to_stand() < 0.05);
}

TEST_CASE("a node that does not answer does not prevent stopping the others", "[hw][guard][safety][wallclock]") {
    const Scratch folder;
    const auto hung = folder.path("power"), motor = folder.path("motor");
    REQUIRE(mkfifo(hung.c_str(), 0600) == 0);
    folder.write("motor", "400");
    // A full pipe that is never read.
    const int reader = open(hung.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    while (write(reader, "x", 1) == 1) {
    }
    const pid_t engine = fork();
    if (engine == 0) {
        for (const int signal : {SIGTERM, SIGSEGV, SIGABRT, SIGINT}) std::signal(signal, SIG_DFL);  // not Catch's
        auto guard = Guard::start("test", motor.string());
        if (guard && guard_file(**guard, 0, hung) && guard_file(**guard, 1, motor)) beat_for_ever(**guard);
        _exit(1);
    }
    guard_sleep(0.3);
    REQUIRE(guarded_text(motor) == "400");
    kill(engine, SIGKILL);
    const double begin = clock_seconds();
    while (guarded_text(motor) != "0" && clock_seconds() - begin < 1) guard_sleep(0.0005);
    CHECK(clock_seconds() - begin < 0.05);
    waitpid(engine, nullptr, 0);
    close(reader);  // ends calls that wait for space
}

TEST_CASE("the motors stand within 250 ms of a stall, and turn again with the next beats",
          "[hw][guard][safety][wallclock]") {
    const Engine engine(beat_for_ever);
    guard_sleep(0.3);
    REQUIRE_FALSE(engine.stands());
    kill(engine.process, SIGSTOP);
    const double time = engine.time_to_stand();
    CHECK(time < 0.25);
    CHECK(time > 0.1);
    kill(engine.process, SIGCONT);
    guard_sleep(0.05);
    std::ofstream(engine.folder.path("motor")) << "400";
    guard_sleep(0.4);
    CHECK(guarded_text(engine.folder.path("motor")) == "400");
}

TEST_CASE("an engine without motor power needs no beats", "[hw][guard][threads][wallclock]") {
    const Engine engine([](Guard& guard) {
        guard.rest();
        for (;;) pause();
    });
    guard_sleep(0.4);
    CHECK_FALSE(engine.stands());
}

TEST_CASE("the engine sees that its guard stopped the motors, does not answer, or is dead",
          "[hw][guard][safety][threads][wallclock]") {
    const Scratch folder;
    const std::string lease = folder.write("power", "1").string();
    auto started = Guard::start("test", lease);
    REQUIRE(started);
    Guard& guard = **started;
    REQUIRE(guard_file(guard, 0, lease));
    guard.beat(clock_seconds());
    CHECK_FALSE(guard.has_stopped());
    guard_sleep(0.3);
    CHECK(guard.has_stopped());
    CHECK_FALSE(guard.has_stopped());
    CHECK(guarded_text(lease) == "0");

    kill(guard.process(), SIGSTOP);
    guard_sleep(0.02);
    guard.beat(clock_seconds());
    guard_sleep(0.25);
    guard.has_stopped();
    CHECK(guard.is_late(clock_seconds()));
    CHECK_FALSE(guard.has_ended());
    kill(guard.process(), SIGCONT);
    guard_sleep(0.05);
    guard.has_stopped();
    CHECK_FALSE(guard.is_late(clock_seconds()));

    kill(guard.process(), SIGKILL);
    guard_sleep(0.05);
    guard.has_stopped();
    CHECK(guard.has_ended());
}

TEST_CASE("a dead engine's lease is free once its guard has stopped the motors", "[hw][guard][safety][wallclock]") {
    const Engine engine(beat_for_ever);
    const std::string node = engine.folder.path("power").string();
    CHECK_FALSE(Lease::take("test", node));
    kill(engine.process, SIGKILL);
    engine.time_to_stand();
    guard_sleep(0.05);
    CHECK(Lease::take("test", node));
}

TEST_CASE("a guard's end leaves no process", "[hw][guard]") {
    const Scratch folder;
    const std::string node = folder.write("rtmotoren0", "1").string();
    auto guard = Guard::start("test", node);
    REQUIRE(guard);
    REQUIRE(guard_file(**guard, 0, node));
    const pid_t process = (*guard)->process();
    guard->reset();
    CHECK(kill(process, 0) != 0);
    CHECK(guarded_text(node) == "0");
}
