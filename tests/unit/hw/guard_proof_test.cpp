// The guard's proofs: it can stop the motors, or it names the node that prevents this.
#include <fcntl.h>
#include <pty.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "hw/device/clock.hpp"
#include "tests/unit/hw/guard_rig.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

// The answer to a beat, which comes within 0.3 s; nothing if there is none.
std::optional<bool> proof_of(Guard& guard) {
    const double begin = clock_seconds();
    guard.beat(begin);
    while (clock_seconds() - begin < 5) {
        guard.has_stopped();
        if (guard.trouble()) return false;
        if (guard.is_proved(clock_seconds())) return true;
        guard_sleep(0.001);
        guard.beat(clock_seconds());
    }
    return std::nullopt;
}

// An earlier proof stays valid for a while.
bool finds_trouble(Guard& guard) {
    const double begin = clock_seconds();
    while (!guard.trouble() && clock_seconds() - begin < 5) {
        guard.beat(clock_seconds());
        guard_sleep(0.001);
        guard.has_stopped();
    }
    return guard.trouble().has_value();
}

}  // namespace

TEST_CASE("without a guard's proof nothing turns, and a guard with nodes proves within a beat",
          "[hw][guard][safety][threads][wallclock]") {
    const Scratch folder;
    const std::string node = folder.write("power", "1").string();
    auto guard = Guard::start("test", node);
    REQUIRE(guard);
    CHECK_FALSE((*guard)->is_proved(clock_seconds()));
    REQUIRE(guard_file(**guard, 0, node));
    CHECK_FALSE((*guard)->is_proved(clock_seconds()));
    CHECK(proof_of(**guard) == true);
    guard_sleep(beat_timeout + 0.05);
    CHECK_FALSE((*guard)->is_proved(clock_seconds()));
}

TEST_CASE("a guard with the order to brake stops its nodes at once and prevents further motion",
          "[hw][guard][safety][threads][wallclock]") {
    const Scratch folder;
    const auto node = folder.write("motor", "400");
    auto guard = Guard::start("test", node.string());
    REQUIRE(guard);
    REQUIRE(guard_file(**guard, 0, node));
    REQUIRE(proof_of(**guard) == true);
    const auto stops = [&] {
        const double begin = clock_seconds();
        while (guarded_text(node) != "0" && clock_seconds() - begin < 5) guard_sleep(0.001);
        return guarded_text(node) == "0";
    };
    std::thread([] { Guard::brake_all(); }).join();
    CHECK(stops());
    // A driving thread may write once more before it checks the guard.
    folder.write("motor", "400");
    guard_sleep(0.02);
    (*guard)->beat(clock_seconds());
    CHECK(stops());
    CHECK((*guard)->has_stopped());
    guard_sleep(beat_timeout + 0.05);
    (*guard)->beat(clock_seconds());
    guard_sleep(0.05);
    (*guard)->has_stopped();
    CHECK_FALSE((*guard)->is_proved(clock_seconds()));
}

TEST_CASE("a proof writes nothing", "[hw][guard][safety][threads][wallclock]") {
    const Scratch folder;
    const auto node = folder.write("power", "1");
    const auto before = std::filesystem::last_write_time(node);
    auto guard = Guard::start("test", node.string());
    REQUIRE(guard);
    REQUIRE(guard_file(**guard, 0, node));
    for (int i = 0; i < 10; ++i) {
        CHECK(proof_of(**guard) == true);
        guard_sleep(0.01);
    }
    CHECK(guarded_text(node) == "1");
    CHECK(std::filesystem::last_write_time(node) == before);
    (*guard)->rest();
}

TEST_CASE("a guard gives no proof for a removed or new node, and says which",
          "[hw][guard][safety][threads][wallclock]") {
    const Scratch folder;
    const auto power = folder.write("power", "1"), motor = folder.write("motor", "400");
    auto guard = Guard::start("test", power.string());
    REQUIRE(guard);
    REQUIRE(guard_file(**guard, 0, power));
    SECTION("removed, and made again") {
        REQUIRE(guard_file(**guard, 1, motor));
        REQUIRE(proof_of(**guard) == true);
        std::filesystem::remove(motor);
        folder.write("motor", "400");
        guard_sleep(0.02);
        REQUIRE(finds_trouble(**guard));
        CHECK(describe(*(*guard)->trouble()) == motor.string() + ": no such file or directory");
        // It is accepted under the same lease.
        REQUIRE(guard_file(**guard, 1, motor));
        CHECK(proof_of(**guard) == true);
        guard->reset();
        CHECK(guarded_text(motor) == "0");
    }
    SECTION("a device that has gone") {
        // Like a node of a USB port or of sysfs: its descriptor is open but accepts no writes.
        int master = -1, device = -1;
        REQUIRE(openpty(&master, &device, nullptr, nullptr, nullptr) == 0);
        const std::string path = ttyname(device);
        REQUIRE(guard_file(**guard, 1, path));
        REQUIRE(proof_of(**guard) == true);
        close(master);
        guard_sleep(0.02);
        REQUIRE(finds_trouble(**guard));
        CHECK(describe(*(*guard)->trouble()) == path + ": input/output error");
        close(device);
    }
}

TEST_CASE("a guard stops nodes by its descriptors when their paths have changed",
          "[hw][guard][safety][threads][wallclock]") {
    const Scratch folder;
    const auto power = folder.write("dev/power", "1");
    auto guard = Guard::start("test", power.string());
    REQUIRE(guard);
    REQUIRE(guard_file(**guard, 0, power));
    std::filesystem::rename(folder.path("dev"), folder.path("hidden"));
    folder.write("dev/power", "another");
    CHECK(proof_of(**guard) == true);
    guard->reset();
    CHECK(guarded_text(folder.path("hidden/power")) == "0");
    CHECK(guarded_text(power) == "another");
}

TEST_CASE("a guard accepts only the node that is open", "[hw][guard][safety]") {
    const Scratch folder;
    const auto power = folder.write("power", "1");
    auto guard = Guard::start("test", power.string());
    REQUIRE(guard);
    Node node(power.string(), Access::write);
    REQUIRE(node.open());
    const Guard::Stop stop{.index = 0, .text = "0", .proof = Proof::empty_write};
    std::filesystem::remove(power);
    const auto gone = (*guard)->take_up(node, stop);
    REQUIRE_FALSE(gone);
    CHECK(describe(gone.error()) == power.string() + ": no such file or directory");
    folder.write("power", "1");
    const auto other = (*guard)->take_up(node, stop);
    REQUIRE_FALSE(other);
    CHECK(describe(other.error()) == power.string() + ": no such device");
}

TEST_CASE("a guard that was suspended with its engine stops the motors before it answers old beats",
          "[hw][guard][safety][threads][wallclock]") {
    const Scratch folder;
    const auto power = folder.write("power", "1");
    auto guard = Guard::start("test", power.string());
    REQUIRE(guard);
    REQUIRE(guard_file(**guard, 0, power));
    REQUIRE(proof_of(**guard) == true);
    kill((*guard)->process(), SIGSTOP);
    guard_sleep(0.02);
    (*guard)->beat(clock_seconds());
    guard_sleep(beat_timeout + 0.1);  // as a suspended engine does
    CHECK_FALSE((*guard)->is_proved(clock_seconds()));
    kill((*guard)->process(), SIGCONT);
    guard_sleep(0.1);
    CHECK((*guard)->has_stopped());
    CHECK_FALSE((*guard)->is_proved(clock_seconds()));
    CHECK(guarded_text(power) == "0");
}

TEST_CASE("the guard's name and command line lack the program's name, and it has its own process group",
          "[hw][guard][safety]") {
    const Scratch folder;
    const std::string node = folder.write("power", "1").string();
    auto guard = Guard::start("test", node);
    REQUIRE(guard);
    REQUIRE(guard_file(**guard, 0, node));
    REQUIRE(proof_of(**guard) == true);
    const std::string process = "/proc/" + std::to_string((*guard)->process());
    CHECK(guarded_text(process + "/comm") == "motor-guard\n");
    const std::string words = guarded_text(process + "/cmdline");
    CHECK(words.c_str() == std::string("motor-guard"));
    CHECK(words.find_first_not_of('\0', words.find('\0')) == words.npos);
    CHECK(getpgid((*guard)->process()) == (*guard)->process());
    CHECK(guarded_text("/proc/self/cmdline") != words);
}

TEST_CASE("as process 1 of a container the motors get no power, and the error says what to do", "[hw][guard][safety]") {
    const Scratch folder;
    const std::string node = folder.write("power", "1").string();
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    const pid_t parent = fork();
    if (parent == 0) {
        if (unshare(CLONE_NEWUSER | CLONE_NEWPID) != 0) _exit(77);
        if (const pid_t first = fork(); first != 0) {
            waitpid(first, nullptr, 0);
            _exit(0);
        }
        const auto guard = Guard::start("test", node);
        const std::string said = guard ? "started" : guard.error().message;
        [[maybe_unused]] const ssize_t written = write(ends[1], said.data(), said.size());
        _exit(0);
    }
    close(ends[1]);
    int status = 0;
    waitpid(parent, &status, 0);
    if (WEXITSTATUS(status) == 77) throw std::runtime_error("SKIPPED: this user may not make a namespace of processes");
    std::string said(1000, '\0');
    said.resize(static_cast<std::size_t>(std::max<ssize_t>(0, read(ends[0], said.data(), said.size()))));
    close(ends[0]);
    CHECK(
        said ==
        "motors: nezumi is process 1 of its container. When it ends, the container ends too, and the motor guard can't "
        "stop the motors. Start nezumi from a shell that ends later, for example: sh -c 'nezumi run ...; sleep 1'");
    CHECK(guarded_text(node) == "1");
}
