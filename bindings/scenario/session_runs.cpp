// Results are kept by the process that made them, so that they survive the session.
#include "bindings/scenario/session_runs.hpp"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "bindings/scenario/process_pool.hpp"

namespace nezumi {

RunResult result_of(const Expected<std::string>& answer) {
    auto result = answer ? from_bytes(*answer) : Expected<RunResult>(Unexpected(answer.error()));
    if (result) return std::move(*result);
    return {.outcome = RunOutcome::could_not_run, .error = result.error()};
}

SessionRuns::SessionRuns(const TestPlan& of_plan, const TestSessionOptions& with_options)
    : plan(of_plan), options(with_options), results(of_plan.runs.size()), kept(of_plan.runs.size()) {
    for (std::size_t run = 0; run < plan.runs.size(); ++run) {
        if (options.shard.has(run)) mine.push_back(run);
    }
    // A search begins when all planned runs have finished.
    std::stable_partition(mine.begin(), mine.end(), [&](std::size_t run) { return !plan.runs[run].searched; });
}

const PlannedRun& SessionRuns::run_of(std::size_t run) const {
    const auto made = searched.find(run);
    return made != searched.end() ? made->second : plan.runs[run];
}

ResultKey SessionRuns::key_of(std::size_t run, std::size_t repetition, bool simplest) const {
    const PlannedRun& planned = plan.runs[run];
    return {plan.files[planned.file].shown, planned.name, repetition, simplest, planned.seed};
}

std::optional<KeptResult> SessionRuns::find_kept(std::size_t run, std::size_t repetition, bool simplest) const {
    return options.resume ? keep->find(key_of(run, repetition, simplest)) : std::nullopt;
}

std::string SessionRuns::stored(std::size_t run, std::size_t repetition, RunResult result) const {
    const PlannedRun& made = run_of(run);
    if (keeps()) {
        const auto is_kept = keep->keep(key_of(run, repetition), {made.name, result, made.seed});
        if (!is_kept && options.keep) {
            result.outcome = RunOutcome::could_not_run;
            result.error = {"the result of this run can't be kept: " + describe(is_kept.error())};
        }
    }
    return to_bytes(result);
}

std::optional<std::vector<RunResult>> SessionRuns::make_all(const std::vector<PlannedRun>& runs, bool quick) const {
    std::vector<RunResult> made(runs.size());
    PoolTasks tasks;
    tasks.count = runs.size();
    tasks.run = [&](std::size_t task) { return to_bytes(run_planned(plan, runs[task], options, quick)); };
    tasks.take = [&](std::size_t task, const Expected<std::string>& answer) { made[task] = result_of(answer); };
    if (run_in_processes(tasks, options.jobs) == PoolEnd::interrupted) return std::nullopt;
    return made;
}

std::vector<std::size_t> SessionRuns::first_failures() const {
    std::vector<std::size_t> failures;
    std::set<std::tuple<std::size_t, std::size_t, std::string, int>> seen;
    for (const std::size_t i : mine) {
        const PlannedRun& run = run_of(i);
        if (!is_drawn(i) || results[i].empty() || results[i].front().outcome != RunOutcome::failed) continue;
        const Place& place = results[i].front().error.place;
        if (seen.emplace(run.file, run.scenario, place.file, place.line).second) failures.push_back(i);
    }
    return failures;
}

bool SessionRuns::is_drawn(std::size_t run) const {
    return run_of(run).drawn || (!results[run].empty() && !results[run].front().drawn.empty());
}

}  // namespace nezumi
