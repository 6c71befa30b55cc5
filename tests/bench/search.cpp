// How many runs of a scenario are made until one fails, for some seeds: chosen by a search, or drawn at random.
//
// tests/bench/search/search.py calls it for each seeded bug. Runs are made in this process, and failures are not
// simplified, which would take more time than the search.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "bindings/lua/reload/lua_host.hpp"
#include "bindings/scenario/search.hpp"
#include "bindings/scenario/test_session.hpp"
#include "engine/ports/payload.hpp"
#include "sim/world.hpp"

using namespace nezumi;

namespace {

struct Tried {
    const TestPlan& plan;
    TestSessionOptions options;
    std::size_t most = 0;

    RunResult run(SweepPoint point) const {
        return run_planned(plan, planned_run(plan, 0, 0, std::move(point), {}), options, true);
    }
    // As SearchedRuns makes them; 0: none has failed.
    std::size_t by_search(const Sweep& sweep, std::uint64_t seed) const {
        Search search(sweep, seed);
        for (std::size_t made = 0; made < most;) {
            const auto points = search.next(most - made);
            for (const SweepPoint& point : points) {
                const RunResult result = run(point);
                ++made;
                if (result.outcome != RunOutcome::passed) return made;
                search.add(point, result);
            }
        }
        return 0;
    }
    std::size_t by_chance(const Sweep& sweep, std::uint64_t seed) const {
        for (std::size_t i = 0; i < most; ++i) {
            if (run(draw_point(sweep, seed, i)).outcome != RunOutcome::passed) return i + 1;
        }
        return 0;
    }
};

}  // namespace

// Usage: bench_search search|samples MOST FIRST_SEED LAST_SEED FILE
int main(int count, char** words) {
    if (count != 6) return std::fprintf(stderr, "usage: bench_search search|samples MOST FIRST LAST FILE\n"), 2;
    const bool searches = std::string(words[1]) == "search";
    TestSessionOptions options;
    options.coverage = searches;
    options.installed = {NEZUMI_SOURCE_ROOT};
    options.systems = [] {
        return LiveOptions{.scripts = &lua_scripts(), .installed = {NEZUMI_SOURCE_ROOT}, .world = sim::make_world};
    };
    const auto plan = plan_tests({.paths = {words[5]}, .seed = 124, .installed = options.installed});
    if (!plan) return std::fprintf(stderr, "%s\n", describe(plan.error()).c_str()), 2;
    const Tried tried{*plan, options, static_cast<std::size_t>(std::atoi(words[2]))};
    const Scenario& scenario = plan->files.front().scenarios.front();
    // The values of `s:any` are shown by a run.
    const RunResult shown = tried.run(point_in(scenario.sweep, {}));
    if (shown.outcome == RunOutcome::could_not_run)
        return std::fprintf(stderr, "%s\n", describe(shown.error).c_str()), 2;
    const Sweep sweep = with_drawn(scenario.sweep, shown.drawn);
    for (int seed = std::atoi(words[3]); seed <= std::atoi(words[4]); ++seed) {
        const std::uint64_t own = mix(static_cast<std::uint64_t>(seed), scenario.name);
        std::printf("%zu\n", searches ? tried.by_search(sweep, own) : tried.by_chance(sweep, own));
        std::fflush(stdout);
    }
    return 0;
}
