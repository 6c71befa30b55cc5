// How much faster than real time a scenario runs: one mouse, its Lua controller, conditions that look at it every tick.
// Also what margins and coverage cost: each compared with the same scenario without, in turns.
//
// Aim: at least 300 times on one core.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bindings/lua/reload/lua_host.hpp"
#include "bindings/scenario/test_session.hpp"
#include "sim/world.hpp"
#include "tests/bench/report.hpp"

using namespace nezumi;

namespace {

constexpr int simulated_seconds = 600;
constexpr int rounds = 9;

// Drives to and fro in front of the wall, so that there is always something to sense and to decide.
std::string scenario_text(const std::string& conditions) {
    return "scenario('it', { timeout = 1000 }, function(s)\n"
           "  local world = s:load 'systems/stop_at_wall.lua'\n" +
           conditions +
           "  for turn = 1, 40 do\n"
           "    world.controller.config.speed_x = turn % 2 == 1 and 0.1 or -0.1\n"
           "    s:run(" +
           std::to_string(simulated_seconds / 40) +
           ")\n"
           "  end\n"
           "end)\n";
}

constexpr const char* own_conditions =
    "  s:always('keeps off', function() return not world.mouse.collided end)\n"
    "  s:always('keeps in', function() return world.mouse.truth.pose.position.x < 0.75 end)\n";

// A function of another file has no margin.
constexpr const char* foreign_conditions =
    "  local conditions = require 'conditions'\n"
    "  s:always('keeps off', conditions.keeps_off(world))\n"
    "  s:always('keeps in', conditions.keeps_in(world))\n";

constexpr const char* conditions_module =
    "local M = {}\n"
    "function M.keeps_off(world) return function() return not world.mouse.collided end end\n"
    "function M.keeps_in(world) return function() return world.mouse.truth.pose.position.x < 0.75 end end\n"
    "return M\n";

struct Variant {
    const char* name;
    const char* conditions;
    bool coverage = false;
    TestPlan plan{};
    double fastest = 1e9;  // [s]
    std::vector<double> ratios{};
};

}  // namespace

int main() {
    bench::print_header("scenarios against real time",
                        "one mouse, tick 100 Hz, physics 5 ms, two conditions looked at after every tick");
    const auto folder = std::filesystem::temp_directory_path() / ("nezumi_bench_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder / "behaviors");
    std::ofstream(folder / "behaviors/conditions.lua") << conditions_module;
    TestSessionOptions options;
    options.installed = {NEZUMI_SOURCE_ROOT};
    options.systems = [] {
        return LiveOptions{.scripts = &lua_scripts(), .installed = {NEZUMI_SOURCE_ROOT}, .world = sim::make_world};
    };
    // The first is what others are compared with.
    Variant variants[] = {{"conditions without margins", foreign_conditions},
                          {"conditions with margins", own_conditions},
                          {"coverage", foreign_conditions, true},
                          {"no conditions", ""}};
    bool passed = true;
    for (Variant& variant : variants) {
        const auto file = folder / (std::string(variant.name) + "_test.lua");
        std::ofstream(file) << scenario_text(variant.conditions);
        auto plan = plan_tests({.paths = {file}, .seed = 124, .installed = options.installed});
        passed = passed && plan.has_value();
        if (passed) variant.plan = std::move(*plan);
    }
    for (int round = 0; passed && round < rounds; ++round) {
        double first = 0;
        for (Variant& variant : variants) {
            options.coverage = variant.coverage;
            const double seconds = bench::time_of([&] {
                const RunResult result = run_planned(variant.plan, variant.plan.runs.front(), options, true);
                passed = passed && result.outcome == RunOutcome::passed;
            });
            variant.fastest = std::min(variant.fastest, seconds);
            if (first == 0) first = seconds;
            variant.ratios.push_back(seconds / first);
        }
    }
    std::filesystem::remove_all(folder);
    if (!passed) {
        std::fprintf(stderr, "the scenario did not pass\n");
        return 1;
    }
    for (Variant& variant : variants)
        std::printf("%-26s  %.3f s, %.3f times the first\n", variant.name, variant.fastest,
                    bench::median(variant.ratios));
    const double fastest = variants[1].fastest;
    std::printf("%d s simulated in %.3f s of one core: %.0f times real time (aim: 300)\n", simulated_seconds, fastest,
                simulated_seconds / fastest);
    return simulated_seconds / fastest >= 300 ? 0 : 1;
}
