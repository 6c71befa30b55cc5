// How long a sweep of 1000 runs of a minute each takes, with a process for each run: one mouse, its Lua controller, a
// condition that looks at it every tick, a measure.
//
// Aim: under a minute on two cores. Other processes on the machine count, so the processes' own CPU time is shown too.
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "bindings/lua/reload/lua_host.hpp"
#include "bindings/scenario/test_session.hpp"
#include "sim/world.hpp"
#include "tests/bench/report.hpp"

using namespace nezumi;

namespace {

constexpr std::size_t jobs = 2;
constexpr double aim = 60;  // [s]

std::string sweep_text(int runs) {
    return "scenario('a minute', { sweep = { n = range(1, " + std::to_string(runs) +
           ", 1) }, samples = " + std::to_string(runs) +
           " }, function(s, p)\n"
           "  local world = s:load 'systems/stop_at_wall.lua'\n"
           "  s:always('keeps off', function() return not world.mouse.collided end)\n"
           "  for turn = 1, 4 do\n"
           "    world.controller.config.speed_x = (turn % 2 == 1 and 0.1 or -0.1) * (1 + 0.0001 * p.n)\n"
           "    s:run(15)\n"
           "  end\n"
           "  s:measure('x', world.mouse.truth.pose.position.x, 'm')\n"
           "end)\n";
}

// [s] of CPU time of this process and of those that it has waited for.
double cpu_seconds() {
    double all = 0;
    for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage used{};
        getrusage(who, &used);
        for (const timeval& part : {used.ru_utime, used.ru_stime})
            all += static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
    }
    return all;
}

}  // namespace

// Usage: bench_sweep [RUNS]
int main(int count, char** words) {
    const int runs = count > 1 ? std::atoi(words[1]) : 1000;
    bench::print_header("a sweep of runs of a minute each",
                        std::to_string(runs) + " runs, " + std::to_string(jobs) +
                            " processes at a time, results kept as they come, one mouse, tick 100 Hz, physics 5 ms");
    const auto folder = std::filesystem::temp_directory_path() / ("nezumi_bench_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "it_test.lua") << sweep_text(runs);
    TestSessionOptions options;
    options.jobs = jobs;
    options.folder = folder / "results";
    options.keep = true;
    options.installed = {NEZUMI_SOURCE_ROOT};
    options.systems = [] {
        return LiveOptions{.scripts = &lua_scripts(), .installed = {NEZUMI_SOURCE_ROOT}, .world = sim::make_world};
    };
    const auto plan = plan_tests({.paths = {folder / "it_test.lua"}, .seed = 124, .installed = options.installed});
    const auto reporter = console_reporter([](std::string_view) {}, false);
    const auto began = std::chrono::steady_clock::now();
    const double cpu_before = cpu_seconds();
    const bool passed = plan.has_value() && run_tests(*plan, options, *reporter).summary.passed == plan->runs.size();
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    const double cpu = cpu_seconds() - cpu_before;
    std::filesystem::remove_all(folder);
    if (!passed) {
        std::fprintf(stderr, "a run did not pass\n");
        return 1;
    }
    const double share = aim * runs / 1000;
    std::printf("%d runs of 60 s in %.1f s (aim: %.1f), %.1f s of CPU time, %.1f ms a run: %s\n", runs, wall, share,
                cpu, 1e3 * cpu / runs, bench::verdict(wall, share));
    return wall <= share ? 0 : 1;
}
