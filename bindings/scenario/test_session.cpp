// Reports are in the order of the plan. A failure of a random sweep waits until it has been simplified.
#include "bindings/scenario/test_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>

#include "bindings/scenario/golden.hpp"
#include "bindings/scenario/process_pool.hpp"
#include "bindings/scenario/search.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

constexpr int most_simplifications = 100;

RunResult result_of(const Expected<std::string>& answer) {
    auto result = answer ? from_bytes(*answer) : Expected<RunResult>(Unexpected(answer.error()));
    if (result) return std::move(*result);
    return {.outcome = RunOutcome::could_not_run, .error = result.error()};
}

// Identifies runs by their number in the plan.
class Session {
public:
    Session(const TestPlan& plan, const TestSessionOptions& options, Reporter& reporter)
        : plan_(plan), options_(options), reporter_(reporter), results_(plan.runs.size()), kept_(plan.runs.size()) {
        for (std::size_t run = 0; run < plan.runs.size(); ++run) {
            if (options.shard.has(run)) mine_.push_back(run);
        }
        // A search begins when all planned runs are made.
        std::stable_partition(mine_.begin(), mine_.end(), [&](std::size_t run) { return !plan.runs[run].searched; });
    }

    // Makes the runs.
    SessionEnd make() {
        std::error_code none;
        had_folder_ = fs::exists(options_.folder, none);
        keep_.emplace(options_.folder, options_.made_with);
        begin();
        take_kept();
        make_rest();
        search_all();
        if (!end_.interrupted) simplify_failures();
        end();
        tidy_up();
        reporter_.end(end_.summary);
        return std::move(end_);
    }

    // Takes the results of other sessions.
    SessionEnd merge(const std::vector<fs::path>& folders, std::size_t shards) {
        for (const fs::path& folder : folders) merged_.emplace_back(folder, options_.made_with);
        begin();
        std::erase_if(mine_, [this](std::size_t run) { return plan_.runs[run].searched && merge_searched(run); });
        for (const std::size_t run : mine_) {
            for (std::size_t i = 0; i < options_.repeat; ++i) results_[run].push_back(find_merged(run, i, shards));
        }
        for (const std::size_t run : first_failures()) {
            for (const ResultStore& store : merged_) {
                auto kept = store.find(key_of(run, 0, true));
                if (!kept) continue;
                take_simplest(run, std::move(*kept));
                break;
            }
        }
        end();
        end_.summary.merged = folders.size();
        reporter_.end(end_.summary);
        return std::move(end_);
    }

private:
    using Made = std::pair<std::size_t, std::size_t>;  // a run and the number of its repetition

    void begin() {
        began_ = std::chrono::steady_clock::now();
        add_unread_files();
        reporter_.begin(unread_.size() + mine_.size());
        for (const RunReport& report : unread_) tell(report, false);
    }

    void end() {
        tell_finished(true);
        measure();
        end_.summary.seed = options_.seed;
        end_.summary.jobs = options_.jobs;
        end_.summary.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
    }

    void add_unread_files() {
        for (const PlannedFile& file : plan_.files) {
            if (file.errors.empty()) continue;
            RunReport report{.file = file.shown};
            report.result.outcome = RunOutcome::could_not_run;
            report.result.error = file.errors.front();
            for (std::size_t i = 1; i < file.errors.size(); ++i)
                report.result.facts.push_back(describe(file.errors[i]));
            unread_.push_back(std::move(report));
        }
    }

    // A run of a search, as it was made.
    const PlannedRun& run_of(std::size_t run) const {
        const auto made = searched_.find(run);
        return made != searched_.end() ? made->second : plan_.runs[run];
    }

    const Scenario& scenario_of(const PlannedRun& run) const { return plan_.files[run.file].scenarios[run.scenario]; }

    ResultKey key_of(std::size_t run, std::size_t repetition, bool simplest = false) const {
        const PlannedRun& planned = plan_.runs[run];
        return {plan_.files[planned.file].shown, planned.name, repetition, simplest, planned.seed};
    }

    // Runs of real robots are never repeatable, and goldens are written by the run itself; so their results are not
    // kept.
    bool keeps() const { return !options_.is_real && !options_.update_goldens; }

    void take_kept() {
        for (const std::size_t run : mine_) {
            if (plan_.runs[run].searched) continue;
            for (std::size_t i = 0; i < options_.repeat; ++i) {
                auto kept = options_.resume ? keep_->find(key_of(run, i)) : std::nullopt;
                if (kept) {
                    ++kept_[run];
                    known_.emplace(Made(run, i), std::move(kept->result));
                } else {
                    to_make_.emplace_back(run, i);
                }
            }
        }
    }

    void make_rest() {
        PoolTasks tasks;
        tasks.count = to_make_.size();
        tasks.run = [this](std::size_t task) { return make_one(to_make_[task]); };
        tasks.take = [this](std::size_t task, const Expected<std::string>& answer) {
            known_.emplace(to_make_[task], result_of(answer));
            take_known();
        };
        if (options_.progress) tasks.progress = [&](std::size_t done) { options_.progress(done, tasks.count); };
        take_known();
        end_.interrupted = run_in_processes(tasks, options_.jobs) == PoolEnd::interrupted;
        if (end_.interrupted) take_out_of_turn();
    }

    // The result as bytes, after it was kept.
    std::string stored(const Made& made, RunResult result) const {
        const PlannedRun& planned = run_of(made.first);
        if (keeps()) {
            const auto kept = keep_->keep(key_of(made.first, made.second), {planned.name, result, planned.seed});
            if (!kept && options_.keep) {
                result.outcome = RunOutcome::could_not_run;
                result.error = {"the result of this run can't be kept: " + describe(kept.error())};
            }
        }
        return to_bytes(result);
    }

    // Runs in a process of its own, which stores the result, so that it survives the session.
    std::string make_one(const Made& made) const {
        const auto& [run, repetition] = made;
        const PlannedRun& planned = run_of(run);
        RunResult result = run_planned(plan_, planned, options_, planned.drawn || repetition > 0);
        return stored(made, std::move(result));
    }

    // A run is complete when all its repetitions are.
    void take_known() {
        for (; taken_ < mine_.size(); ++taken_) {
            const std::size_t run = mine_[taken_];
            std::vector<RunResult>& results = results_[run];
            for (auto found = known_.find(Made(run, results.size())); found != known_.end();
                 found = known_.find(Made(run, results.size()))) {
                results.push_back(std::move(found->second));
                known_.erase(found);
            }
            if (results.size() < options_.repeat) break;
        }
        tell_finished(false);
    }

    void search_all() {
        for (auto first = std::find_if(mine_.begin(), mine_.end(), [&](auto run) { return plan_.runs[run].searched; });
             first != mine_.end() && !end_.interrupted;) {
            const PlannedRun& run = plan_.runs[*first];
            const auto is_other = [&](std::size_t other) {
                return plan_.runs[other].file != run.file || plan_.runs[other].scenario != run.scenario;
            };
            const auto last = std::find_if(first, mine_.end(), is_other);
            const std::vector<std::size_t> places(first, last);
            const auto left = static_cast<std::size_t>(mine_.end() - last);
            const std::size_t made = search(places);
            // The places that it did not need.
            mine_.erase(mine_.end() - static_cast<std::ptrdiff_t>(left + places.size() - made),
                        mine_.end() - static_cast<std::ptrdiff_t>(left));
            first = mine_.end() - static_cast<std::ptrdiff_t>(left);
        }
        if (!end_.interrupted) tell_finished(false);
    }

    // Makes runs of one scenario, in rounds, until one has failed. Returns how many of the places were needed.
    std::size_t search(const std::vector<std::size_t>& places) {
        const PlannedRun& first = plan_.runs[places.front()];
        const Scenario& scenario = scenario_of(first);
        Sweep sweep = scenario.sweep;
        if (scenario.draws) {
            // A run that is not reported shows what it draws.
            const auto shown = run_all({planned_run(plan_, first.file, first.scenario, {}, {})}, true);
            if (end_.interrupted) return 0;
            sweep = with_drawn(std::move(sweep), shown.front().drawn);
        }
        Search search(sweep, mix(seed_of(plan_.seed, scenario.name), options_.shard.index));
        std::size_t made = 0;
        bool has_failed = false;
        while (made < places.size() && !has_failed && !end_.interrupted) {
            const auto points = search.next(places.size() - made);
            std::vector<std::size_t> round;
            for (const SweepPoint& point : points) {
                round.push_back(places[made++]);
                PlannedRun run = planned_run(plan_, first.file, first.scenario, point, {});
                run.drawn = true;
                searched_.insert_or_assign(round.back(), std::move(run));
            }
            make_round(round, sweep);
            for (std::size_t i = 0; i < round.size() && !end_.interrupted; ++i) {
                const RunResult& result = results_[round[i]].front();
                search.add(points[i], result);
                has_failed = has_failed || result.outcome != RunOutcome::passed;
            }
            if (options_.progress) options_.progress(made, places.size());
        }
        if (end_.interrupted || !keeps()) return made;
        for (std::size_t i = made; i < places.size() && options_.keep; ++i)
            static_cast<void>(keep_->keep(key_of(places[i], 0), {}));
        return made;
    }

    void make_round(const std::vector<std::size_t>& round, const Sweep& sweep) {
        std::vector<Made> missing;
        for (const std::size_t run : round) {
            for (std::size_t i = 0; i < options_.repeat; ++i) {
                auto kept = options_.resume ? keep_->find(key_of(run, i)) : std::nullopt;
                if (kept && kept->name == run_of(run).name) {
                    ++kept_[run];
                    results_[run].push_back(std::move(kept->result));
                } else {
                    results_[run].emplace_back();
                    missing.emplace_back(run, i);
                }
            }
        }
        TestSessionOptions options = options_;
        options.coverage = true;
        std::set<std::size_t> done;
        PoolTasks tasks;
        tasks.count = missing.size();
        tasks.run = [&](std::size_t task) { return make_searched(missing[task], sweep, options); };
        tasks.take = [&](std::size_t task, const Expected<std::string>& answer) {
            results_[missing[task].first][missing[task].second] = result_of(answer);
            done.insert(missing[task].first);
        };
        end_.interrupted = run_in_processes(tasks, options_.jobs) == PoolEnd::interrupted;
        if (!end_.interrupted) return;
        for (const auto& [run, repetition] : missing) {
            if (!done.contains(run)) results_[run].clear();
        }
    }

    // In a process of its own, as make_one.
    std::string make_searched(const Made& made, const Sweep& sweep, const TestSessionOptions& options) const {
        const auto& [run, repetition] = made;
        const PlannedRun& planned = run_of(run);
        RunResult result = run_planned(plan_, planned, options, true);
        // All values, for whoever merges: the plan has only the number of the run.
        std::vector<DrawnValue> values = drawn_values(sweep, planned.point);
        for (DrawnValue& value : result.drawn) {
            const auto same = [&](const DrawnValue& other) { return other.name == value.name; };
            if (std::none_of(values.begin(), values.end(), same)) values.push_back(std::move(value));
        }
        result.drawn = std::move(values);
        return stored(made, std::move(result));
    }

    // Takes the name and the values of a run of a search from its result. Returns whether the search ended before it.
    bool merge_searched(std::size_t run) {
        for (const ResultStore& store : merged_) {
            const auto kept = store.find(key_of(run, 0));
            if (!kept) continue;
            if (kept->name.empty()) return true;
            PlannedRun made = plan_.runs[run];
            made.name = kept->name;
            made.seed = kept->seed;
            for (const DrawnValue& value : kept->result.drawn)
                made.point.emplace_back(value.name, SweepValue{{}, value.text});
            searched_.insert_or_assign(run, std::move(made));
            return false;
        }
        return false;
    }

    // Runs before them are missing, so they would never be reported in order.
    void take_out_of_turn() {
        for (auto& [made, result] : known_) results_[made.first].push_back(std::move(result));
        known_.clear();
    }

    // Whether the result of a run is known. If the session was interrupted, one failure is enough, whatever the number
    // of repetitions.
    bool is_over(std::size_t run) const {
        const std::vector<RunResult>& results = results_[run];
        const auto passed = [](const RunResult& result) { return result.outcome == RunOutcome::passed; };
        return results.size() == options_.repeat ||
               (end_.interrupted && !std::all_of(results.begin(), results.end(), passed));
    }

    RunResult find_merged(std::size_t run, std::size_t repetition, std::size_t shards) const {
        for (const ResultStore& store : merged_) {
            if (auto kept = store.find(key_of(run, repetition))) return std::move(kept->result);
        }
        return {.outcome = RunOutcome::could_not_run,
                .error = {fmt::format("this run is missing: no folder has its result; --shard {}/{} --resume makes it",
                                      run % shards + 1, shards)}};
    }

    // Reports all runs that are next in order; after an interruption, all that are known. Failures of random sweeps
    // wait for the end.
    void tell_finished(bool all) {
        for (; next_ < mine_.size(); ++next_) {
            const std::size_t index = mine_[next_];
            if (!is_over(index)) {
                if (end_.interrupted) continue;
                return;
            }
            const PlannedRun& run = run_of(index);
            const bool is_kept = kept_[index] == options_.repeat;
            const auto simpler = simplified_.find(index);
            if (simpler != simplified_.end()) {
                told_.push_back(index);
                tell(simpler->second, is_kept);
                continue;
            }
            RunResult result = agree(results_[index], scenario_of(run).place);
            if (!all && is_drawn(index) && result.outcome == RunOutcome::failed) return;
            told_.push_back(index);
            if (auto own = goldens_.add(result.goldens, run.name); !own) {
                result.outcome = RunOutcome::could_not_run;
                result.error = own.error();
                result.facts.clear();
                results_[index].assign(1, result);
            }
            if (is_drawn(index) && result.outcome == RunOutcome::failed) shorten(run, result);
            tell(report_of(plan_, run, std::move(result), options_), is_kept);
        }
    }

    // The runs as they were planned; the simplest failure of a random sweep is an additional run.
    void measure() {
        for (const std::size_t index : told_) {
            const PlannedRun& run = run_of(index);
            const RunResult result = agree(results_[index], scenario_of(run).place);
            end_.coverage.add(scenario_of(run).name, result.coverage);
            end_.measured.push_back(
                {.scenario = scenario_of(run).name,
                 .name = run.name,
                 .point = run.point,
                 .seed = run.seed,
                 .paired = scenario_of(run).paired,
                 .repetition = run.repetition.name,
                 .passed = result.outcome == RunOutcome::passed,
                 .measures = result.measures,
                 .margins = result.margins,
                 .counts = !result.component_failed && result.outcome != RunOutcome::could_not_run});
        }
        end_.summary.measures = summarize(end_.measured);
        end_.summary.pairs = summarize_pairs(end_.measured);
        end_.summary.margins = summarize_margins(end_.measured);
    }

    // Whether a failure of the run can be simplified.
    bool is_drawn(std::size_t run) const {
        return run_of(run).drawn || (!results_[run].empty() && !results_[run].front().drawn.empty());
    }

    // Omits facts that are also in the report of the simplest failure.
    void shorten(const PlannedRun& run, RunResult& result) const {
        for (const auto& [index, simplest] : simplified_) {
            const PlannedRun& found = run_of(index);
            if (found.file != run.file || found.scenario != run.scenario) continue;
            if (simplest.result.error.place != result.error.place) continue;
            result.facts = {"fails in the same line as the simplest failure: " + simplest.name};
            result.printed.clear();
            result.margins.clear();
        }
    }

    void tell(const RunReport& report, bool is_kept) {
        switch (report.result.outcome) {
            case RunOutcome::passed: ++end_.summary.passed; break;
            case RunOutcome::failed: ++end_.summary.failed; break;
            case RunOutcome::could_not_run: ++end_.summary.could_not_run; break;
        }
        if (is_kept) {
            ++end_.summary.kept;
        } else {
            end_.summary.seconds += report.result.seconds;
        }
        reporter_.add(report);
        end_.reports.push_back(report);
    }

    // One failure for each random sweep and each kind: failures at the same place of a scenario are similar.
    std::vector<std::size_t> first_failures() const {
        std::vector<std::size_t> failures;
        std::set<std::tuple<std::size_t, std::size_t, std::string, int>> seen;
        for (const std::size_t i : mine_) {
            const PlannedRun& run = run_of(i);
            if (!is_drawn(i) || results_[i].empty() || results_[i].front().outcome != RunOutcome::failed) continue;
            const Place& place = results_[i].front().error.place;
            if (seen.emplace(run.file, run.scenario, place.file, place.line).second) failures.push_back(i);
        }
        return failures;
    }

    void simplify_failures() {
        for (const std::size_t run : first_failures()) {
            if (end_.interrupted) return;
            if (auto kept = options_.resume ? keep_->find(key_of(run, 0, true)) : std::nullopt) {
                take_simplest(run, std::move(*kept));
            } else {
                simplify(run);
            }
        }
    }

    std::vector<RunResult> run_all(const std::vector<PlannedRun>& runs, bool quick) {
        std::vector<RunResult> results(runs.size());
        PoolTasks tasks;
        tasks.count = runs.size();
        tasks.run = [&](std::size_t task) { return to_bytes(run_planned(plan_, runs[task], options_, quick)); };
        tasks.take = [&](std::size_t task, const Expected<std::string>& answer) { results[task] = result_of(answer); };
        if (run_in_processes(tasks, options_.jobs) == PoolEnd::interrupted) end_.interrupted = true;
        return results;
    }

    void simplify(std::size_t index) {
        const PlannedRun& found = run_of(index);
        const Scenario& scenario = scenario_of(found);
        const Error error = results_[index].front().error;
        const std::vector<DrawnValue> drawn = results_[index].front().drawn;
        const Sweep sweep = with_drawn(scenario.sweep, drawn);
        PlannedRun simplest = found;
        simplest.point = with_drawn(found.point, drawn);
        for (int step = 0; step < most_simplifications && !end_.interrupted; ++step) {
            std::vector<PlannedRun> candidates;
            for (SweepPoint& point : simpler(sweep, simplest.point)) {
                candidates.push_back(
                    planned_run(plan_, found.file, found.scenario, std::move(point), found.repetition));
            }
            const std::vector<RunResult> results = run_all(candidates, true);
            std::size_t next = 0;
            // Looks for the same failure; another failure may have another reason.
            while (next < results.size() &&
                   (results[next].outcome != RunOutcome::failed || results[next].error.place != error.place))
                ++next;
            if (next == results.size()) break;
            simplest = candidates[next];
        }
        if (end_.interrupted) return;
        // Values of s:any that came from the seed of the run are not in its name.
        if (simplest.point == with_drawn(found.point, drawn)) simplest = found;
        RunResult result = run_all({simplest}, false).front();
        if (end_.interrupted) return;
        // When results are merged, this is found by the planned run; without it, the planned run is reported.
        if (keeps()) static_cast<void>(keep_->keep(key_of(index, 0, true), {simplest.name, result, simplest.seed}));
        take_simplest(index, {simplest.name, std::move(result), simplest.seed});
    }

    void take_simplest(std::size_t index, KeptResult kept) {
        RunResult& result = kept.result;
        PlannedRun simplest = run_of(index);
        std::size_t samples = 0;
        std::size_t failed = 0;
        for (const std::size_t i : mine_) {
            const PlannedRun& run = run_of(i);
            if (run.file != simplest.file || run.scenario != simplest.scenario) continue;
            ++samples;
            if (!results_[i].empty() && results_[i].front().outcome == RunOutcome::failed &&
                results_[i].front().error.place == results_[index].front().error.place)
                ++failed;
        }
        if (kept.name != simplest.name)
            result.facts.insert(
                result.facts.begin(),
                fmt::format("first seen with {}", text_of(with_drawn(simplest.point, results_[index].front().drawn))));
        result.facts.insert(
            result.facts.begin(),
            fmt::format("{} of {} samples failed; this is the simplest failure found", failed, samples));
        simplest.name = kept.name;
        simplest.seed = kept.seed;
        simplified_.emplace(index, report_of(plan_, simplest, std::move(result), options_));
    }

    // Removes results that no session resumes or merges.
    void tidy_up() {
        const auto is_kept = [](const std::vector<RunResult>& results) { return !results.empty(); };
        end_.can_resume = end_.interrupted && keeps() && std::any_of(results_.begin(), results_.end(), is_kept);
        if (end_.interrupted || options_.keep || !keeps()) return;
        for (const std::size_t run : mine_) {
            for (std::size_t i = 0; i < options_.repeat; ++i) keep_->forget(key_of(run, i));
        }
        for (const auto& simplest : simplified_) keep_->forget(key_of(simplest.first, 0, true));
        keep_->remove_if_empty(!had_folder_);
    }

    const TestPlan& plan_;
    const TestSessionOptions& options_;
    Reporter& reporter_;
    std::optional<ResultStore> keep_;
    bool had_folder_ = false;
    std::vector<ResultStore> merged_;
    std::chrono::steady_clock::time_point began_;
    std::vector<std::size_t> mine_;               // runs of this part, in order
    std::map<std::size_t, PlannedRun> searched_;  // runs of searches, with their values
    std::vector<RunReport> unread_;
    std::vector<Made> to_make_;
    std::map<Made, RunResult> known_;              // results that are not reported yet
    std::vector<std::vector<RunResult>> results_;  // of each run, one for each repetition
    std::vector<std::size_t> kept_;                // of each run: number of results from an earlier session
    GoldenOwners goldens_;
    std::map<std::size_t, RunReport> simplified_;
    std::size_t taken_ = 0;          // number of `mine_` that are complete
    std::size_t next_ = 0;           // index in `mine_` of the next report
    std::vector<std::size_t> told_;  // runs
    SessionEnd end_;
};

}  // namespace

SessionEnd run_tests(const TestPlan& plan, const TestSessionOptions& options, Reporter& reporter) {
    return Session(plan, options, reporter).make();
}

SessionEnd merge_tests(const KeptPlan& plan, const std::vector<fs::path>& folders, Reporter& reporter) {
    TestSessionOptions options;
    options.seed = plan.seed;
    options.repeat = static_cast<std::size_t>(plan.repeat);
    options.words = plan.words;
    options.made_with = plan.made_with;
    return Session(plan.plan, options, reporter).merge(folders, static_cast<std::size_t>(plan.shards));
}

}  // namespace nezumi
