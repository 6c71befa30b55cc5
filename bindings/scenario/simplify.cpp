// Tries simpler values as long as one of them fails in the same place.
#include "bindings/scenario/simplify.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "bindings/scenario/search.hpp"

namespace nezumi {
namespace {

constexpr int most_simplifications = 100;

}  // namespace

std::optional<KeptResult> simplify_failure(const SessionRuns& runs, std::size_t run) {
    if (auto kept = runs.find_kept(run, 0, true)) return kept;
    const PlannedRun& found = runs.run_of(run);
    const RunResult& failure = runs.results[run].front();
    const Sweep sweep = with_drawn(runs.scenario_of(found).sweep, failure.drawn);
    PlannedRun simplest = found;
    simplest.point = with_drawn(found.point, failure.drawn);
    for (int step = 0; step < most_simplifications; ++step) {
        std::vector<PlannedRun> candidates;
        for (SweepPoint& point : simpler(sweep, simplest.point)) {
            candidates.push_back(
                planned_run(runs.plan, found.file, found.scenario, std::move(point), found.repetition));
        }
        const auto results = runs.make_all(candidates, true);
        if (!results) return std::nullopt;
        std::size_t next = 0;
        // Looks for the same failure; another failure may have another reason.
        while (next < results->size() &&
               ((*results)[next].outcome != RunOutcome::failed || (*results)[next].error.place != failure.error.place))
            ++next;
        if (next == results->size()) break;
        simplest = candidates[next];
    }
    // If nothing became simpler, this is the run itself: its name does not contain the values that s:any drew by its
    // seed.
    if (simplest.point == with_drawn(found.point, failure.drawn)) simplest = found;
    auto result = runs.make_all({simplest}, false);
    if (!result) return std::nullopt;
    KeptResult kept{simplest.name, std::move(result->front()), simplest.seed};
    // Merging finds this result under the key of the planned run. Without it, merging reports the planned run.
    if (runs.keeps()) static_cast<void>(runs.keep->keep(runs.key_of(run, 0, true), kept));
    return kept;
}

RunReport report_of_simplest(const SessionRuns& runs, std::size_t run, KeptResult simplest) {
    RunResult& result = simplest.result;
    PlannedRun reported = runs.run_of(run);
    const RunResult& failure = runs.results[run].front();
    std::size_t samples = 0;
    std::size_t failed = 0;
    for (const std::size_t i : runs.mine) {
        const PlannedRun& other = runs.run_of(i);
        if (other.file != reported.file || other.scenario != reported.scenario) continue;
        ++samples;
        const std::vector<RunResult>& results = runs.results[i];
        if (!results.empty() && results.front().outcome == RunOutcome::failed &&
            results.front().error.place == failure.error.place)
            ++failed;
    }
    if (simplest.name != reported.name)
        result.facts.insert(result.facts.begin(),
                            fmt::format("first seen with {}", text_of(with_drawn(reported.point, failure.drawn))));
    result.facts.insert(result.facts.begin(),
                        fmt::format("{} of {} samples failed; this is the simplest failure found", failed, samples));
    reported.name = simplest.name;
    reported.seed = simplest.seed;
    return report_of(runs.plan, reported, std::move(result), runs.options);
}

}  // namespace nezumi
