// A real robot drives on and the run ends even if its output blocks.
#include <fcntl.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <string>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/cli/sinks.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

// Drives ahead, and turns after 3 s.
void write_turning_system(const FakeMouse& fake, const std::string& more) {
    fake.folder.write("behaviors/ahead.lua",
                      "local out = output('out', 'TimedVelocity2D', 'velocity')\n"
                      "function on_execute()\n"
                      "  out:write { vx = now() < 3 and 0.15 or 0, va = now() < 3 and 0 or 0.5 }\n" +
                          more + "\nend\n");
    fake.folder.write("system.lua",
                      "robot 'mouse' { model = 'raspimouse' }\nbehavior 'driver' { script = 'ahead' }\n"
                      "connect('driver.out', 'mouse.target_velocity_in')\n");
}

// Waits until it has turned: then the blocked output has not stopped it.
bool turns(FakeMouse& fake) {
    return FakeMouse::wait_until([&] { return fake.motion().left < -10 && fake.motion().right > 10; }, 20);
}

}  // namespace

TEST_CASE("a robot drives on when its log output is not read, and stops by SIGTERM",
          "[hw][ends][fakes][safety][wallclock]") {
    FakeMouse fake;
    write_turning_system(fake, "for i = 1, 10 do log.info(('x'):rep(1000)) end");
    Program run({"run", "system.lua", "--hw", "--headless", "--dev-root", fake.dev()}, fake.folder.path("").string());
    REQUIRE(turns(fake));
    const double begin = clock_seconds();
    run.send(SIGTERM);
    REQUIRE(FakeMouse::wait_until([&] { return !fake.moves(); }, 3));
    CHECK(fake.motion().still_since - begin < 0.05);
    CHECK(run.wait_unread(30) == 1);
    CHECK(clock_seconds() - begin < 2.5);
}

TEST_CASE("a device log that accepts no writes is abandoned, with a message", "[hw][ends][fakes][wallclock]") {
    FakeMouse fake;
    write_turning_system(fake, "");
    const std::string fifo = fake.folder.path("fifo").string();
    REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
    const int reader = open(fifo.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    Program run({"run", "system.lua", "--hw", "--headless", "--dev-root", fake.dev(), "--device-log", fifo},
                fake.folder.path("").string());
    REQUIRE(turns(fake));
    const Sink& promised = sink("`--device-log`");
    const double begin = clock_seconds();
    run.send(SIGTERM);
    CHECK(run.wait() == promised.status);
    CHECK(clock_seconds() - begin < 2.5);
    CHECK(run.error.find(
              "the device log can't be written: it did not accept all data in time: the run continues without it\n") !=
          std::string::npos);
    close(reader);
}

TEST_CASE("a second signal ends the program after the guard has braked", "[hw][ends][fakes][safety][wallclock]") {
    FakeMouse fake;
    write_turning_system(fake, "");
    Program run({"run", "system.lua", "--hw", "--headless", "--dev-root", fake.dev()}, fake.folder.path("").string());
    REQUIRE(FakeMouse::wait_until([&] { return fake.motion().left > 390; }, 20));
    // Two signals of one kind could be merged.
    run.send(SIGTERM);
    run.send(SIGINT);
    const auto status = run.wait_unread(30);
    const auto motion = fake.motion();  // at once
    CHECK((status == -SIGINT || status == -SIGTERM));
    CHECK(motion.left == 0);
    CHECK(motion.right == 0);
}
