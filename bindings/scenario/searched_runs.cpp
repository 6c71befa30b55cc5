// In rounds: all runs of a round are chosen before it, so that processes can run them in any order.
#include "bindings/scenario/searched_runs.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "bindings/scenario/process_pool.hpp"
#include "bindings/scenario/search.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi {
namespace {

// The search in one scenario.
class SearchedRuns {
public:
    // `places` are the runs of the plan that it may make.
    SearchedRuns(SessionRuns& runs, std::vector<std::size_t> places)
        : runs_(runs),
          places_(std::move(places)),
          first_(runs.plan.runs[places_.front()]),
          sweep_(runs.scenario_of(first_).sweep) {}

    // Makes runs until one has failed. Returns how many of the places were needed; nothing if a signal interrupted.
    std::optional<std::size_t> make() {
        const Scenario& scenario = runs_.scenario_of(first_);
        if (scenario.draws) {
            // A run that is not reported, with middle values, shows what it draws.
            const auto shown =
                runs_.make_all({planned_run(runs_.plan, first_.file, first_.scenario, point_in(sweep_, {}), {})}, true);
            if (!shown) return std::nullopt;
            sweep_ = with_drawn(std::move(sweep_), shown->front().drawn);
        }
        Search search(sweep_, mix(seed_of(runs_.plan.seed, scenario.name), runs_.options.shard.index));
        std::size_t made = 0;
        bool has_failed = false;
        while (made < places_.size() && !has_failed) {
            const auto points = search.next(places_.size() - made);
            if (points.empty()) break;
            std::vector<std::size_t> round;
            for (const SweepPoint& point : points) {
                round.push_back(places_[made++]);
                PlannedRun run = planned_run(runs_.plan, first_.file, first_.scenario, point, {});
                run.drawn = true;
                runs_.searched.insert_or_assign(round.back(), std::move(run));
            }
            if (!make_round(round)) return std::nullopt;
            for (std::size_t i = 0; i < round.size(); ++i) {
                const RunResult& result = runs_.results[round[i]].front();
                search.add(points[i], result);
                has_failed = has_failed || result.outcome != RunOutcome::passed;
            }
            if (runs_.options.progress) runs_.options.progress(made, places_.size());
        }
        if (!runs_.keeps() || !runs_.options.keep) return made;
        // Empty results tell `--merge` that the search ended before these runs.
        for (std::size_t i = made; i < places_.size(); ++i)
            static_cast<void>(runs_.keep->keep(runs_.key_of(places_[i], 0), {}));
        return made;
    }

private:
    using Made = std::pair<std::size_t, std::size_t>;  // a run and the number of its repetition

    // Makes the runs of a round, except those with a kept result. Returns false if a signal interrupted them.
    bool make_round(const std::vector<std::size_t>& round) {
        std::vector<Made> missing;
        for (const std::size_t run : round) {
            for (std::size_t i = 0; i < runs_.options.repeat; ++i) {
                auto kept = runs_.find_kept(run, i);
                if (kept && kept->name == runs_.run_of(run).name) {
                    ++runs_.kept[run];
                    runs_.results[run].push_back(std::move(kept->result));
                } else {
                    runs_.results[run].emplace_back();
                    missing.emplace_back(run, i);
                }
            }
        }
        TestSessionOptions options = runs_.options;
        options.coverage = true;
        std::set<std::size_t> done;
        PoolTasks tasks;
        tasks.count = missing.size();
        tasks.run = [&](std::size_t task) { return make_one(missing[task], options); };
        tasks.take = [&](std::size_t task, const Expected<std::string>& answer) {
            runs_.results[missing[task].first][missing[task].second] = result_of(answer);
            done.insert(missing[task].first);
        };
        if (run_in_processes(tasks, options.jobs) != PoolEnd::interrupted) return true;
        for (const auto& [run, repetition] : missing) {
            if (!done.contains(run)) runs_.results[run].clear();
        }
        return false;
    }

    // Makes one run. Called in a separate process.
    std::string make_one(const Made& made, const TestSessionOptions& options) const {
        const auto& [run, repetition] = made;
        const PlannedRun& planned = runs_.run_of(run);
        RunResult result = run_planned(runs_.plan, planned, options, true);
        // The result stores all drawn values for `--merge`, because the plan has only the number of the run.
        std::vector<DrawnValue> values = drawn_values(sweep_, planned.point);
        for (DrawnValue& value : result.drawn) {
            const auto same = [&](const DrawnValue& other) { return other.name == value.name; };
            if (std::none_of(values.begin(), values.end(), same)) values.push_back(std::move(value));
        }
        result.drawn = std::move(values);
        return runs_.stored(run, repetition, std::move(result));
    }

    SessionRuns& runs_;
    std::vector<std::size_t> places_;
    const PlannedRun& first_;
    Sweep sweep_;  // with the values of `s:any`
};

}  // namespace

bool search_all(SessionRuns& runs) {
    std::vector<std::size_t>& mine = runs.mine;
    const auto is_searched = [&](std::size_t run) { return runs.plan.runs[run].searched; };
    for (auto first = std::find_if(mine.begin(), mine.end(), is_searched); first != mine.end();) {
        const PlannedRun& run = runs.plan.runs[*first];
        const auto is_other = [&](std::size_t other) {
            return runs.plan.runs[other].file != run.file || runs.plan.runs[other].scenario != run.scenario;
        };
        const auto last = std::find_if(first, mine.end(), is_other);
        const auto made = SearchedRuns(runs, {first, last}).make();
        if (!made) return false;
        // Removes the places that the search did not need.
        first = mine.erase(first + static_cast<std::ptrdiff_t>(*made), last);
    }
    return true;
}

bool merge_searched(SessionRuns& runs, std::size_t run, const std::vector<ResultStore>& merged) {
    for (const ResultStore& store : merged) {
        const auto kept = store.find(runs.key_of(run, 0));
        if (!kept) continue;
        if (kept->name.empty()) return true;
        PlannedRun made = runs.plan.runs[run];
        made.name = kept->name;
        made.seed = kept->seed;
        for (const DrawnValue& value : kept->result.drawn)
            made.point.emplace_back(value.name, SweepValue{{}, value.text});
        runs.searched.insert_or_assign(run, std::move(made));
        return false;
    }
    return false;
}

}  // namespace nezumi
