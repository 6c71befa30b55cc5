// Reports are in the order of the plan. A failure of a random sweep waits until it has been simplified.
#include "bindings/scenario/test_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <string>
#include <system_error>
#include <utility>

#include "bindings/scenario/golden.hpp"
#include "bindings/scenario/process_pool.hpp"
#include "bindings/scenario/searched_runs.hpp"
#include "bindings/scenario/session_runs.hpp"
#include "bindings/scenario/simplify.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

class Session {
public:
    Session(const TestPlan& plan, const TestSessionOptions& options, Reporter& reporter)
        : plan_(plan), options_(options), reporter_(reporter), runs_(plan, options) {}

    // Makes the runs.
    SessionEnd make() {
        std::error_code none;
        had_folder_ = fs::exists(options_.folder, none);
        runs_.keep.emplace(options_.folder, options_.made_with);
        begin();
        take_kept();
        make_rest();
        if (!end_.interrupted) end_.interrupted = !search_all(runs_);
        if (!end_.interrupted) tell_finished(false);
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
        std::erase_if(runs_.mine, [this](std::size_t run) {
            return plan_.runs[run].searched && merge_searched(runs_, run, merged_);
        });
        for (const std::size_t run : runs_.mine) {
            for (std::size_t i = 0; i < options_.repeat; ++i) runs_.results[run].push_back(find_merged(run, i, shards));
        }
        for (const std::size_t run : runs_.first_failures()) {
            for (const ResultStore& store : merged_) {
                auto kept = store.find(runs_.key_of(run, 0, true));
                if (!kept) continue;
                simplified_.emplace(run, report_of_simplest(runs_, run, std::move(*kept)));
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
        reporter_.begin(unread_.size() + runs_.mine.size());
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

    void take_kept() {
        for (const std::size_t run : runs_.mine) {
            if (plan_.runs[run].searched) continue;
            for (std::size_t i = 0; i < options_.repeat; ++i) {
                auto kept = runs_.find_kept(run, i);
                if (kept) {
                    ++runs_.kept[run];
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

    // Called in a separate process, which stores the result, so that the result survives the session.
    std::string make_one(const Made& made) const {
        const auto& [run, repetition] = made;
        const PlannedRun& planned = runs_.run_of(run);
        RunResult result = run_planned(plan_, planned, options_, planned.drawn || repetition > 0);
        return runs_.stored(run, repetition, std::move(result));
    }

    // Moves known results to their runs, in order, up to the first run that lacks a repetition.
    void take_known() {
        for (; taken_ < runs_.mine.size(); ++taken_) {
            const std::size_t run = runs_.mine[taken_];
            std::vector<RunResult>& results = runs_.results[run];
            for (auto found = known_.find(Made(run, results.size())); found != known_.end();
                 found = known_.find(Made(run, results.size()))) {
                results.push_back(std::move(found->second));
                known_.erase(found);
            }
            if (results.size() < options_.repeat) break;
        }
        tell_finished(false);
    }

    // Moves the other results to their runs too. Earlier runs are missing, so these would never be reported in order.
    void take_out_of_turn() {
        for (auto& [made, result] : known_) runs_.results[made.first].push_back(std::move(result));
        known_.clear();
    }

    // Whether the result of a run is known. If the session was interrupted, one failure is enough, whatever the number
    // of repetitions.
    bool is_over(std::size_t run) const {
        const std::vector<RunResult>& results = runs_.results[run];
        const auto passed = [](const RunResult& result) { return result.outcome == RunOutcome::passed; };
        return results.size() == options_.repeat ||
               (end_.interrupted && !std::all_of(results.begin(), results.end(), passed));
    }

    RunResult find_merged(std::size_t run, std::size_t repetition, std::size_t shards) const {
        for (const ResultStore& store : merged_) {
            if (auto kept = store.find(runs_.key_of(run, repetition))) return std::move(kept->result);
        }
        return {.outcome = RunOutcome::could_not_run,
                .error = {fmt::format("this run is missing: no folder has its result; --shard {}/{} --resume makes it",
                                      run % shards + 1, shards)}};
    }

    // Reports all runs that are next in order; after an interruption, all that are known. Failures of random sweeps
    // wait for the end.
    void tell_finished(bool all) {
        for (; next_ < runs_.mine.size(); ++next_) {
            const std::size_t index = runs_.mine[next_];
            if (!is_over(index)) {
                if (end_.interrupted) continue;
                return;
            }
            const PlannedRun& run = runs_.run_of(index);
            const bool is_kept = runs_.kept[index] == options_.repeat;
            const auto simpler = simplified_.find(index);
            if (simpler != simplified_.end()) {
                told_.push_back(index);
                tell(simpler->second, is_kept);
                continue;
            }
            RunResult result = agree(runs_.results[index], runs_.scenario_of(run).place);
            if (!all && runs_.is_drawn(index) && result.outcome == RunOutcome::failed) return;
            told_.push_back(index);
            if (auto own = goldens_.add(result.goldens, run.name); !own) {
                result.outcome = RunOutcome::could_not_run;
                result.error = own.error();
                result.facts.clear();
                runs_.results[index].assign(1, result);
            }
            if (runs_.is_drawn(index) && result.outcome == RunOutcome::failed) shorten(run, result);
            tell(report_of(plan_, run, std::move(result), options_), is_kept);
        }
    }

    // The name of a scenario, and its file if another file has a scenario of that name.
    std::string own_name(const PlannedRun& run) const {
        const std::string& name = runs_.scenario_of(run).name;
        for (std::size_t file = 0; file < plan_.files.size(); ++file) {
            const std::vector<Scenario>& others = plan_.files[file].scenarios;
            const auto called_so = [&](const Scenario& other) { return other.name == name; };
            if (file != run.file && std::any_of(others.begin(), others.end(), called_so))
                return fmt::format("{} ({})", name, plan_.files[run.file].shown);
        }
        return name;
    }

    // Measures the runs as they were planned. A simplest failure does not count, because it is an additional run.
    void measure() {
        for (const std::size_t index : told_) {
            const PlannedRun& run = runs_.run_of(index);
            const RunResult result = agree(runs_.results[index], runs_.scenario_of(run).place);
            const std::string scenario = own_name(run);
            end_.coverage.add(scenario, result.coverage);
            end_.measured.push_back(
                {.scenario = scenario,
                 .name = run.name,
                 .point = run.point,
                 .seed = run.seed,
                 .paired = runs_.scenario_of(run).paired,
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

    // Omits facts that are also in the report of the simplest failure.
    void shorten(const PlannedRun& run, RunResult& result) const {
        for (const auto& [index, simplest] : simplified_) {
            const PlannedRun& found = runs_.run_of(index);
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

    void simplify_failures() {
        for (const std::size_t run : runs_.first_failures()) {
            auto simplest = simplify_failure(runs_, run);
            end_.interrupted = !simplest;
            if (end_.interrupted) return;
            simplified_.emplace(run, report_of_simplest(runs_, run, std::move(*simplest)));
        }
    }

    // Removes results that no session resumes or merges.
    void tidy_up() {
        const auto is_kept = [](const std::vector<RunResult>& results) { return !results.empty(); };
        end_.can_resume =
            end_.interrupted && runs_.keeps() && std::any_of(runs_.results.begin(), runs_.results.end(), is_kept);
        if (end_.interrupted || options_.keep || !runs_.keeps()) return;
        for (const std::size_t run : runs_.mine) {
            for (std::size_t i = 0; i < options_.repeat; ++i) runs_.keep->forget(runs_.key_of(run, i));
        }
        for (const auto& simplest : simplified_) runs_.keep->forget(runs_.key_of(simplest.first, 0, true));
        runs_.keep->remove_if_empty(!had_folder_);
    }

    const TestPlan& plan_;
    const TestSessionOptions& options_;
    Reporter& reporter_;
    SessionRuns runs_;
    bool had_folder_ = false;
    std::vector<ResultStore> merged_;
    std::chrono::steady_clock::time_point began_;
    std::vector<RunReport> unread_;
    std::vector<Made> to_make_;
    std::map<Made, RunResult> known_;  // results that are not reported yet
    GoldenOwners goldens_;
    std::map<std::size_t, RunReport> simplified_;
    std::size_t taken_ = 0;          // number of `runs_.mine` that are complete
    std::size_t next_ = 0;           // index in `runs_.mine` of the next report
    std::vector<std::size_t> told_;  // runs that were reported
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
