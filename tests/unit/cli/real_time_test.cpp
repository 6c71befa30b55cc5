// `--realtime`, and what a run tells of its ticks.
#include "bindings/cli/run/real_time.hpp"

#include <catch2/catch.hpp>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::cli;
using Catch::Matchers::Contains;

namespace {

// What is told when the kernel answers so; and what it was asked for.
std::string told(int scheduled, int locked, std::string* asked = nullptr) {
    std::string calls;
    std::string text;
    {
        const RealTime real_time({.schedule =
                                      [&](int priority) {
                                          calls += std::to_string(priority) + " ";
                                          return scheduled;
                                      },
                                  .lock_memory =
                                      [&] {
                                          calls += "lock ";
                                          return locked;
                                      }});
        text = real_time.told();
    }
    if (asked != nullptr) *asked = calls;
    return text;
}

// By thread of a process: its policy, as in sched(7).
std::map<std::string, int> policies_of(pid_t process) {
    std::map<std::string, int> policies;
    for (const auto& thread : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
        std::string text;
        std::getline(std::ifstream(thread.path() / "stat"), text);
        if (text.empty()) continue;  // it has ended meanwhile
        std::istringstream fields(text.substr(text.rfind(')') + 2));
        std::string field;
        for (int i = 3; i <= 41; ++i) fields >> field;
        policies[thread.path().filename().string()] = std::stoi(field);
    }
    return policies;
}

}  // namespace

TEST_CASE("one line reports which real-time settings the kernel allowed, and how to allow the others",
          "[cli][realtime]") {
    std::string asked;
    CHECK(told(0, 0, &asked) == "--realtime: SCHED_FIFO with priority 40, memory is locked");
    CHECK(asked == "lock 40 0 ");  // and given back
    const std::string advice =
        "; to allow it, write '* - rtprio 40' and '* - memlock unlimited' on two lines of "
        "/etc/security/limits.d/nezumi.conf and log in again";
    CHECK(told(EPERM, EPERM, &asked) ==
          "--realtime: no SCHED_FIFO (Operation not permitted), memory is not locked (Operation not permitted)" +
              advice);
    CHECK(asked == "lock 40 ");
    CHECK(told(0, ENOMEM) ==
          "--realtime: SCHED_FIFO with priority 40, memory is not locked (Cannot allocate memory)" + advice);
    CHECK(told(EPERM, 0) == "--realtime: no SCHED_FIFO (Operation not permitted), memory is locked" + advice);
}

TEST_CASE("the option --realtime is for runs that follow the clock with one thread", "[cli][realtime]") {
    const auto refused = [](std::vector<std::string> more) {
        std::vector<std::string> words{"run", "behaviors/systems/stop_at_wall.lua", "--realtime"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run_nezumi(words);
        CHECK(outcome.status == 2);
        return outcome.error;
    };
    const std::string no_clock =
        "nezumi: --realtime: works only in real time: leave it out, or give --speed a number\n";
    CHECK(refused({"--speed", "max"}) == no_clock);
    CHECK(refused({"--batch"}) == no_clock);
    CHECK(refused({"--threads", "2"}) == "nezumi: --realtime: works only with a single thread: leave out --threads\n");
}

TEST_CASE("only the thread that ticks runs before all others", "[cli][realtime]") {
    const Scratch scratch;
    Program program({"run", "behaviors/systems/stop_at_wall.lua", "--headless", "--realtime", "--duration", "30",
                     "--record", scratch.path("r.csv").string(), "--journal", scratch.path("j").string()});
    REQUIRE(program.wait_for_error("--realtime: "));
    REQUIRE(program.wait_for_error("\n"));
    const std::string attached = run_nezumi({"attach", std::to_string(program.process()), "--eval", "6 * 7"}).out;
    CHECK(attached == "42\n");  // so that there are threads of consoles
    const auto policies = policies_of(program.process());
    const bool allowed = program.error.find("SCHED_FIFO with priority 40") != std::string::npos;
    CHECK(policies.size() >= 4);
    for (const auto& [thread, policy] : policies) {
        CAPTURE(thread);
        CHECK(policy == (allowed && thread == std::to_string(program.process()) ? SCHED_FIFO : SCHED_OTHER));
    }
    program.send(SIGINT);
    CHECK(program.wait() == 0);
}

TEST_CASE("only a run that follows the clock reports at its end how late its ticks were", "[cli][run]") {
    const std::string paced =
        run_nezumi({"run", "behaviors/systems/stop_at_wall.lua", "--headless", "--duration", "0.3"}).error;
    INFO(paced);
    CHECK(std::regex_search(
        paced, std::regex("ticks began late by p50 \\d+\\.\\d\\d ms, p99 \\d+\\.\\d\\d ms, worst \\d+\\.\\d\\d ms")));
    const std::string unpaced =
        run_nezumi({"run", "behaviors/systems/stop_at_wall.lua", "--headless", "--duration", "0.3", "--speed", "max"})
            .error;
    CHECK_THAT(unpaced, Contains("s simulated in") && !Contains("began late"));
}
