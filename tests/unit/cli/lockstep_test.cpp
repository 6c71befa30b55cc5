// Processes in lockstep: the same hashes each time, whatever holds up one of them, and alone when the network is away.
#include <algorithm>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

using Words = std::vector<std::string>;

// Three hosts in a ring, each of which publishes what depends on all that it has heard; a robot is driven by another
// host.
struct Ring {
    explicit Ring(int domain, const std::string& more = "") {
        scratch.write("behaviors/mixing.lua", R"(
local heard = input("in", "TimedLong", "", { queue = 100 })
local out = output("out", "TimedLong")
local speed = output("speed", "TimedVelocity2D")
state.sum, state.count = 0, 0
function on_execute()
  while heard.is_new do state.sum = (31 * state.sum + heard:read()) % 10007 end
  state.count = state.count + 1
  out:write((state.sum + state.count) % 10007)
  speed:write { vx = 0.001 * (state.sum % 100), va = 0.01 * (state.count % 10) }
end
)");
        const auto host = [&](const std::string& name, const std::string& from, const std::string& to) {
            return scratch
                .write(name + ".lua", "seed(1)\nnetwork { name = \"" + name + "\", domain = " + std::to_string(domain) +
                                          ", lockstep = true, hosts = \"" + to + "\"" + more +
                                          " }\nrobot \"mouse\" { model = \"raspimouse\", noise = 0.02 }\n"
                                          "behavior \"it\" { script = \"mixing\" }\nconnect(\"" +
                                          from + "/it.out\", \"it.in\")\nconnect(\"" + from +
                                          "/it.speed\", \"mouse.target_velocity_in\")\n")
                .string();
        };
        files = {host("a", "c", "b"), host("b", "a", "c"), host("c", "b", "a")};
    }
    Scratch scratch;
    std::array<std::string, 3> files;
};

std::string hash_of(const std::string& out) {
    const std::size_t at = out.find("trace hash: ");
    return at != std::string::npos ? out.substr(at + 12, 16) : "none: " + out;
}

// Runs all to their end, and holds up one after the other meanwhile.
std::array<std::string, 3> run_all(const std::array<Words, 3>& words, unsigned seed, const std::string& input = "") {
    std::array<std::unique_ptr<Program>, 3> all;
    for (std::size_t i = 0; i < 3; ++i)
        all[i] = std::make_unique<Program>(words[i], "", words[i].back() == "--batch" ? input : "");
    std::atomic<bool> over = false;
    std::thread trouble([&] {
        std::mt19937 random(seed);
        while (!over) {
            const Program& one = *all[random() % 3];
            one.send(SIGSTOP);
            std::this_thread::sleep_for(std::chrono::milliseconds(random() % 60));
            one.send(SIGCONT);
            std::this_thread::sleep_for(std::chrono::milliseconds(random() % 40));
        }
    });
    std::array<std::string, 3> hashes;
    for (std::size_t i = 0; i < 3; ++i) {
        const int status = all[i]->wait();
        if (!over.exchange(true)) trouble.join();
        INFO(all[i]->error);
        CHECK(status == 0);
        hashes[i] = hash_of(all[i]->out);
    }
    return hashes;
}

Words run(const std::string& file, const std::string& speed) {
    return {"run", file, "--headless", "--speed", speed, "--duration", "2", "--trace-hash"};
}

}  // namespace

TEST_CASE("hosts in lockstep have the same hashes each time, whichever host is slow",
          "[cli][network][lockstep][wallclock]") {
    Ring ring(224);
    const auto& [a, b, c] = ring.files;
    const auto first = run_all({run(a, "max"), run(b, "max"), run(c, "max")}, 1);
    CHECK(first[0] != first[1]);
    CHECK(first[1] != first[2]);
    CHECK(run_all({run(a, "max"), run(b, "max"), run(c, "max")}, 2) == first);
    CHECK(run_all({run(c, "max"), run(a, "2"), run(b, "1")}, 3) ==
          std::array<std::string, 3>{first[2], first[0], first[1]});
    // By commands, and with a journal, whose replay needs nobody.
    const std::string commands = ring.scratch.write("commands", "run(0.5)\nstep(50)\nrun(1)\n").string();
    const std::string journal = ring.scratch.path("journal").string();
    Words journaled = run(b, "max");
    journaled.insert(journaled.end(), {"--journal", journal});
    CHECK(run_all({Words{"run", a, "--trace-hash", "--batch"}, journaled, run(c, "max")}, 4, commands) == first);
    const Outcome again = run_nezumi({"run", b, "--headless", "--replay", journal, "--trace-hash"});
    INFO(again.error);
    CHECK(again.status == 0);
    CHECK(hash_of(again.out) == first[1]);
}

TEST_CASE("a secret keeps lockstep among those who have it", "[cli][network][lockstep][wallclock]") {
    Ring ring(225, ", secret = \"s.key\"");
    REQUIRE(run_nezumi({"network", "secret", ring.scratch.path("s.key").string()}).status == 0);
    const auto& [a, b, c] = ring.files;
    const auto first = run_all({run(a, "max"), run(b, "max"), run(c, "max")}, 1);
    CHECK(run_all({run(a, "max"), run(b, "max"), run(c, "max")}, 2) == first);
}

TEST_CASE("a run that waits for other hosts says so and ends by Ctrl-C at once",
          "[cli][network][lockstep][wallclock]") {
    Ring ring(226);
    Program waits({"run", ring.files[0], "--headless"});
    REQUIRE(waits.wait_for_error("lockstep: time is stopped at 0.00 s: waits for host b"));
    const auto begin = std::chrono::steady_clock::now();
    waits.send(SIGINT);
    CHECK(waits.wait() == 0);
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(3));
}

TEST_CASE("time stands for all while a host is stopped, and one that is killed and started again is taken in",
          "[cli][network][lockstep][wallclock]") {
    Ring ring(227);
    Program a({"run", ring.files[0], "--headless"}), b({"run", ring.files[1], "--headless"});
    {
        Program c({"run", ring.files[2], "--headless"});
        REQUIRE(a.wait_for_error("in step with host c"));
        REQUIRE(b.wait_for_error("in step with host c"));
        c.send(SIGSTOP);
        REQUIRE(a.wait_for_error("time is stopped at"));
        REQUIRE(b.wait_for_error("time is stopped at"));
        // One of them may have the last step of c, and then waits for the other.
        const bool one_says_so = a.wait_for_error("host c is silent", 5) || b.wait_for_error("host c is silent", 5);
        REQUIRE(one_says_so);
        c.send(SIGCONT);
        REQUIRE(a.wait_for_error("lockstep: time continues"));
        c.send(SIGKILL);
        c.wait();
        a.error.clear();
        REQUIRE(a.wait_for_error("time is stopped at"));
    }
    Program c({"run", ring.files[2], "--headless"});
    REQUIRE(a.wait_for_error("in step with host c from "));
    REQUIRE(a.wait_for_error("lockstep: time continues"));
    std::this_thread::sleep_for(std::chrono::seconds(1));  // all three tick
    c.send(SIGINT);
    CHECK(c.wait() == 0);
    REQUIRE(a.wait_for_error("host c has ended: this one continues without it"));
    a.send(SIGINT);
    b.send(SIGINT);
    CHECK(a.wait() == 0);
    CHECK(b.wait() == 0);
}

TEST_CASE("lockstep is refused where time can't wait, or where everybody could hold it up",
          "[cli][network][lockstep]") {
    Scratch scratch;
    const std::string real =
        scratch
            .write(
                "real.lua",
                "network { name = \"a\", domain = 228, lockstep = true }\nrobot \"mouse\" { model = \"raspimouse\" }\n")
            .string();
    for (const char* node : {"rtmotoren0", "rtmotor_raw_l0", "rtmotor_raw_r0", "rtled0", "rtled1", "rtled2", "rtled3",
                             "rtbuzzer0", "rtswitch0", "rtswitch1", "rtswitch2"})
        scratch.write(node, "1\n");
    scratch.write("rtlightsensor0", "0 0 0 0\n");
    const std::string nodes = scratch.path("").string();
    const Outcome hardware = run_nezumi({"run", real, "--hw", "--headless", "--dev-root", nodes, "--duration", "1"});
    INFO(hardware.error);
    CHECK(hardware.status == 2);
    CHECK(hardware.error.find(
              "real.lua:1: network: 'lockstep' works only in simulation: time does not wait for real robots") !=
          std::string::npos);
    const std::string open =
        scratch.write("open.lua", "seed(1)\nnetwork { name = \"a\", interface = \"lo\", lockstep = true }\n").string();
    const Outcome anybody = run_nezumi({"run", open, "--headless", "--duration", "1"});
    CHECK(anybody.status == 2);
    CHECK(anybody.error.find(
              "open.lua:2: network: 'lockstep' lets other hosts stop this system's time: it needs `secret`, or "
              "`open = true`") != std::string::npos);
}

TEST_CASE("a scenario waits for no other host", "[cli][network][lockstep]") {
    Ring ring(228);
    ring.scratch.write("ring_test.lua", R"(
scenario("goes on alone", { timeout = 5 }, function(s)
  local world = s:load "a.lua"
  s:run(1)
  s:check(world.it.ports.out.value == 100, "it has counted by itself")
end)
)");
    const Outcome tested = run_nezumi({"test", ring.scratch.path("ring_test.lua").string()});
    INFO(tested.out + tested.error);
    CHECK(tested.status == 0);
}
