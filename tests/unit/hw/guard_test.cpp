// The guard process: whatever ends or stalls the engine, the motors stop.
#include "hw/guard/guard.hpp"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include "hw/device/clock.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

void guard_sleep(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

std::string content(const std::filesystem::path& file) {
    std::string text;
    std::ifstream(file) >> text;
    return text;
}

// An engine in a process of its own, whose motor turns.
struct Engine {
    explicit Engine(const std::function<void(Guard&)>& live) {
        folder.write("power", "1");
        folder.write("motor", "400");
        int ready[2];
        REQUIRE(pipe(ready) == 0);
        process = fork();
        if (process == 0) {
            for (const int signal : {SIGTERM, SIGSEGV, SIGABRT, SIGINT}) std::signal(signal, SIG_DFL);  // not Catch's
            auto guard = Guard::start(folder.path("power").string(),
                                      {{folder.path("power").string(), "0"}, {folder.path("motor").string(), "0"}});
            if (!guard) _exit(1);
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
    bool stands() const { return content(folder.path("power")) == "0" && content(folder.path("motor")) == "0"; }
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

TEST_CASE("they stand as soon when something of the dead engine still keeps its files open",
          "[hw][guard][safety][wallclock]") {
    // As a thread does that waits in the kernel for a device's answer.
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

TEST_CASE("a node that does not answer keeps no other from being stopped", "[hw][guard][safety][wallclock]") {
    const Scratch folder;
    const auto hung = folder.path("power"), motor = folder.path("motor");
    REQUIRE(mkfifo(hung.c_str(), 0600) == 0);  // to open it takes a reader, who never comes
    folder.write("motor", "400");
    folder.write("lease", "");
    const pid_t engine = fork();
    if (engine == 0) {
        for (const int signal : {SIGTERM, SIGSEGV, SIGABRT, SIGINT}) std::signal(signal, SIG_DFL);  // not Catch's
        auto guard = Guard::start(folder.path("lease").string(), {{hung.string(), "0"}, {motor.string(), "0"}});
        if (guard) beat_for_ever(**guard);
        _exit(1);
    }
    guard_sleep(0.3);
    REQUIRE(content(motor) == "400");
    kill(engine, SIGKILL);
    const double begin = clock_seconds();
    while (content(motor) != "0" && clock_seconds() - begin < 1) guard_sleep(0.0005);
    CHECK(clock_seconds() - begin < 0.05);
    waitpid(engine, nullptr, 0);
    std::ifstream(hung) >> std::ws;  // lets what waits for a reader end
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
    CHECK(content(engine.folder.path("motor")) == "400");
}

TEST_CASE("an engine whose motors rest need not beat", "[hw][guard][threads][wallclock]") {
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
    auto started = Guard::start(lease, {{lease, "0"}});
    REQUIRE(started);
    Guard& guard = **started;
    guard.beat(clock_seconds());
    CHECK_FALSE(guard.has_stopped());
    guard_sleep(0.3);
    CHECK(guard.has_stopped());
    CHECK_FALSE(guard.has_stopped());
    CHECK(content(lease) == "0");

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

TEST_CASE("one program at a time drives the motors, and the other is told which", "[hw][guard][safety]") {
    const Scratch folder;
    const std::string node = folder.write("rtmotoren0", "").string();
    auto first = Guard::start(node, {});
    REQUIRE(first);
    const auto second = Guard::start(node, {});
    REQUIRE_FALSE(second);
    CHECK(second.error().message == node +
                                        ": another robot of this system drives these motors already: only one of "
                                        "them can be real, as by --hw=NAME");
    first->reset();
    CHECK(Guard::start(node, {}));
}

TEST_CASE("a dead engine's lease is free once its guard has stopped the motors", "[hw][guard][safety][wallclock]") {
    const Engine engine(beat_for_ever);
    const std::string node = engine.folder.path("power").string();
    CHECK_FALSE(Lease::take(node));
    kill(engine.process, SIGKILL);
    engine.time_to_stand();
    guard_sleep(0.05);
    CHECK(Lease::take(node));
}

TEST_CASE("a guard that ends leaves no process behind", "[hw][guard]") {
    const Scratch folder;
    const std::string node = folder.write("rtmotoren0", "1").string();
    auto guard = Guard::start(node, {{node, "0"}});
    REQUIRE(guard);
    const pid_t process = (*guard)->process();
    guard->reset();
    CHECK(kill(process, 0) != 0);
    CHECK(content(node) == "0");
}
