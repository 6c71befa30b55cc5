// The order of reports is the plan's; a failure of a random sweep waits until it has been simplified.
#include "bindings/scenario/test_session.hpp"

#include <fmt/format.h>

#include <chrono>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "bindings/scenario/failure_folder.hpp"
#include "bindings/scenario/process_pool.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

constexpr int most_simplifications = 100;

RunResult run_once(const PlannedFile& file, const PlannedRun& run, const SessionOptions& options, RunFiles* files,
                   bool keep_history) {
    auto read = ScenarioFile::read(file.path, {.installed = options.installed, .seed = options.seed});
    if (!read) return {.outcome = RunOutcome::could_not_run, .error = read.error()};
    if (run.scenario >= (*read)->scenarios().size())
        return {.outcome = RunOutcome::could_not_run, .error = {"the file has changed meanwhile", {file.shown}}};
    ScenarioRun scenario(**read, run.scenario,
                         {.seed = options.seed,
                          .point = run.point,
                          .systems = options.systems,
                          .files = files,
                          .keep_history = keep_history,
                          .update_goldens = options.update_goldens});
    return scenario.run();
}

std::string command_for(const PlannedFile& file, const PlannedRun& run, const SessionOptions& options) {
    return fmt::format("nezumi test {} --filter {} --seed {}{}", shell_text(file.shown), shell_text(run.name),
                       options.seed, options.words);
}

RunReport report_of(const TestPlan& plan, const PlannedRun& run, RunResult result, const SessionOptions& options) {
    const PlannedFile& file = plan.files[run.file];
    const Scenario& scenario = file.scenarios[run.scenario];
    return {scenario.place.file, scenario.place.line, scenario.name, run.name, command_for(file, run, options),
            std::move(result)};
}

RunResult result_of(const Expected<std::string>& answer) {
    auto result = answer ? from_bytes(*answer) : Expected<RunResult>(Unexpected(answer.error()));
    if (result) return std::move(*result);
    return {.outcome = RunOutcome::could_not_run, .error = result.error()};
}

// The results of the same run, made several times: they must be alike.
RunResult agree(std::vector<RunResult> results, const Scenario& scenario) {
    RunResult first = results.front();
    for (std::size_t i = 1; i < results.size(); ++i) {
        if (results[i].hash == first.hash && results[i].outcome == first.outcome) continue;
        if (first.outcome == RunOutcome::could_not_run) break;
        if (results[i].outcome == RunOutcome::could_not_run) return std::move(results[i]);
        first.outcome = RunOutcome::failed;
        first.error = {fmt::format("the same run differs: the first has hash {:016x}, number {} has {:016x}",
                                   first.hash, i + 1, results[i].hash),
                       scenario.place};
        break;
    }
    return first;
}

class Session {
public:
    Session(const TestPlan& plan, const SessionOptions& options, Reporter& reporter)
        : plan_(plan), options_(options), reporter_(reporter) {}

    SessionEnd run() {
        const auto began = std::chrono::steady_clock::now();
        add_unread_files();
        reporter_.begin(unread_.size() + plan_.runs.size());
        results_.resize(plan_.runs.size());
        PoolTasks tasks;
        tasks.count = plan_.runs.size() * options_.repeat;
        tasks.run = [this](std::size_t task) {
            const PlannedRun& planned = plan_.runs[task / options_.repeat];
            return to_bytes(run_planned(plan_, planned, options_, planned.drawn || task % options_.repeat > 0));
        };
        tasks.take = [this](std::size_t task, const Expected<std::string>& answer) {
            take(task / options_.repeat, result_of(answer));
        };
        if (options_.progress) tasks.progress = [&](std::size_t done) { options_.progress(done, tasks.count); };
        for (const RunReport& report : unread_) tell(report);
        end_.interrupted = run_in_processes(tasks, options_.jobs) == PoolEnd::interrupted;
        if (!end_.interrupted) simplify_failures();
        tell_finished(true);
        measure();
        end_.summary.seed = options_.seed;
        end_.summary.jobs = options_.jobs;
        end_.summary.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
        reporter_.end(end_.summary);
        return std::move(end_);
    }

private:
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

    void take(std::size_t run, RunResult result) {
        results_[run].push_back(std::move(result));
        tell_finished(false);
    }

    // Tells of all runs whose turn it is. Failures of random sweeps wait for the end.
    void tell_finished(bool all) {
        for (; told_ < plan_.runs.size() && results_[told_].size() == options_.repeat; ++told_) {
            const PlannedRun& run = plan_.runs[told_];
            const auto simpler = simplified_.find(told_);
            if (simpler != simplified_.end()) {
                tell(simpler->second);
                continue;
            }
            const Scenario& scenario = plan_.files[run.file].scenarios[run.scenario];
            RunResult result = agree(results_[told_], scenario);
            if (!all && run.drawn && result.outcome == RunOutcome::failed) return;
            if (run.drawn && result.outcome == RunOutcome::failed) shorten(run, result);
            tell(report_of(plan_, run, std::move(result), options_));
        }
    }

    // The runs as they were planned: the simplest failure of a random sweep is another one, which was sought.
    void measure() {
        for (std::size_t i = 0; i < told_; ++i) {
            const PlannedRun& run = plan_.runs[i];
            const Scenario& scenario = plan_.files[run.file].scenarios[run.scenario];
            const RunResult result = agree(results_[i], scenario);
            end_.measured.push_back({.scenario = scenario.name,
                                     .name = run.name,
                                     .point = run.point,
                                     .passed = result.outcome == RunOutcome::passed,
                                     .measures = result.measures});
        }
        end_.summary.measures = summarize(end_.measured);
    }

    // What is said of the simplest failure of a random sweep need not be said of each.
    void shorten(const PlannedRun& run, RunResult& result) const {
        for (const auto& [index, simplest] : simplified_) {
            const PlannedRun& found = plan_.runs[index];
            if (found.file != run.file || found.scenario != run.scenario) continue;
            if (simplest.result.error.place != result.error.place) continue;
            result.facts = {"fails where the simplest failure does: " + simplest.name};
            result.printed.clear();
            result.margins.clear();
        }
    }

    void tell(const RunReport& report) {
        switch (report.result.outcome) {
            case RunOutcome::passed: ++end_.summary.passed; break;
            case RunOutcome::failed: ++end_.summary.failed; break;
            case RunOutcome::could_not_run: ++end_.summary.could_not_run; break;
        }
        end_.summary.seconds += report.result.seconds;
        reporter_.add(report);
        end_.reports.push_back(report);
    }

    // The first failure of each random sweep.
    void simplify_failures() {
        std::vector<std::pair<std::size_t, std::size_t>> seen;
        for (std::size_t i = told_; i < plan_.runs.size() && !end_.interrupted; ++i) {
            const PlannedRun& run = plan_.runs[i];
            const std::pair scenario{run.file, run.scenario};
            if (!run.drawn || results_[i].front().outcome != RunOutcome::failed) continue;
            if (!seen.empty() && seen.back() == scenario) continue;
            seen.push_back(scenario);
            simplify(i);
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
        const PlannedRun& found = plan_.runs[index];
        const Scenario& scenario = plan_.files[found.file].scenarios[found.scenario];
        const Error error = results_[index].front().error;
        PlannedRun simplest = found;
        for (int step = 0; step < most_simplifications && !end_.interrupted; ++step) {
            std::vector<PlannedRun> candidates;
            for (SweepPoint& point : simpler(scenario.sweep, simplest.point)) {
                std::string name = name_of_run(scenario, point);
                candidates.push_back({found.file, found.scenario, std::move(point), std::move(name), true});
            }
            const std::vector<RunResult> results = run_all(candidates, true);
            std::size_t next = 0;
            // The same failure: another one may be of another kind.
            while (next < results.size() &&
                   (results[next].outcome != RunOutcome::failed || results[next].error.place != error.place))
                ++next;
            if (next == results.size()) break;
            simplest = candidates[next];
        }
        if (end_.interrupted) return;
        RunResult result = run_all({simplest}, false).front();
        std::size_t failed = 0;
        for (std::size_t i = 0; i < plan_.runs.size(); ++i) {
            const PlannedRun& run = plan_.runs[i];
            if (run.file == found.file && run.scenario == found.scenario && !results_[i].empty() &&
                results_[i].front().outcome == RunOutcome::failed)
                ++failed;
        }
        if (simplest.name != found.name)
            result.facts.insert(result.facts.begin(), fmt::format("first seen with {}", text_of(found.point)));
        result.facts.insert(
            result.facts.begin(),
            fmt::format("{} of {} samples failed; this is the simplest failure found", failed, scenario.sweep.samples));
        simplified_.emplace(index, report_of(plan_, simplest, std::move(result), options_));
    }

    const TestPlan& plan_;
    const SessionOptions& options_;
    Reporter& reporter_;
    std::vector<RunReport> unread_;
    std::vector<std::vector<RunResult>> results_;  // of each run, as often as it is made
    std::map<std::size_t, RunReport> simplified_;
    std::size_t told_ = 0;
    SessionEnd end_;
};

}  // namespace

RunResult run_planned(const TestPlan& plan, const PlannedRun& run, const SessionOptions& options, bool quick) {
    const PlannedFile& file = plan.files[run.file];
    std::optional<RunResult> first;
    if (quick || !options.is_real) first = run_once(file, run, options, nullptr, false);
    if (first && (quick || first->outcome != RunOutcome::failed)) return std::move(*first);
    const auto folder = make_failure_folder(options.folder / run_file_name(file.shown, run.name, file.has_own_stem));
    std::unique_ptr<RunFiles> files;
    if (folder && options.files) files = options.files(*folder);
    RunResult again = run_once(file, run, options, files.get(), true);
    if (first) {
        if (again.outcome != first->outcome || again.hash != first->hash)
            again.facts.push_back(
                fmt::format("the same run again differs: it had hash {:016x}, then {:016x}", first->hash, again.hash));
        again.outcome = RunOutcome::failed;
        again.wall_seconds = first->wall_seconds;
    } else if (again.outcome != RunOutcome::failed) {
        std::error_code none;
        if (folder) fs::remove_all(*folder, none);
        again.files.clear();
        return again;
    }
    if (!folder) {
        again.facts.push_back(folder.error().message);
        return again;
    }
    again.folder = *folder;
    again.files.emplace_back("failure.txt");
    std::string text;
    for (const std::string& line : failure_lines(report_of(plan, run, again, options))) text += line + "\n";
    text += fmt::format("seed: {}\n", options.seed);
    for (const std::string& line : again.printed) text += "| " + line + "\n";
    if (auto ok = write_whole(fs::path(*folder) / "failure.txt", text); !ok) {
        again.files.pop_back();
        again.facts.push_back(describe(ok.error()));
    }
    if (again.files.empty()) {
        std::error_code none;
        fs::remove(*folder, none);
        again.folder.clear();
    }
    return again;
}

SessionEnd run_tests(const TestPlan& plan, const SessionOptions& options, Reporter& reporter) {
    return Session(plan, options, reporter).run();
}

}  // namespace nezumi
