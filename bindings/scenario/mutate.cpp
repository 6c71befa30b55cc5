// Changes a behaviour, one place at a time, and checks whether its scenarios notice. Each change is a task in a
// separate process, which reads the changed text in place of the file.
#include "bindings/scenario/mutate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "bindings/lua/syntax/lexer.hpp"
#include "bindings/scenario/process_pool.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/project/project_files.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

// The disk with another text in one file.
class ChangedFile final : public ProjectFiles {
public:
    ChangedFile(fs::path file, std::string text) : file_(std::move(file)), text_(std::move(text)) {}

    fs::path working_folder() const override { return disk().working_folder(); }
    std::string what_is(const fs::path& path) const override { return disk().what_is(path); }
    std::vector<std::string> names_in(const fs::path& folder) const override { return disk().names_in(folder); }
    Expected<std::string> read(const fs::path& path, const std::string& shown) const override {
        std::error_code none;
        return fs::equivalent(path, file_, none) ? Expected<std::string>(text_) : disk().read(path, shown);
    }

private:
    fs::path file_;
    std::string text_;
};

// A run that loads the file.
struct Candidate {
    const PlannedRun* run;
    double seconds;  // that it takes
    std::vector<CoveredLine> lines;

    // Whether the run executes a line. A line without statements counts as executed.
    bool executes(int line) const {
        const auto found =
            std::find_if(lines.begin(), lines.end(), [&](const auto& each) { return each.line == line; });
        return found == lines.end() || found->ran;
    }
};

// Runs the plan without a change.
Expected<std::vector<Candidate>> candidates_of(const TestPlan& plan, const std::string& file, std::uint64_t hash,
                                               TestSessionOptions options, bool& interrupted) {
    options.coverage = true;
    std::vector<Candidate> candidates;
    std::optional<Error> failed;
    PoolTasks tasks;
    tasks.count = plan.runs.size();
    tasks.run = [&](std::size_t task) { return to_bytes(run_planned(plan, plan.runs[task], options, true)); };
    tasks.take = [&](std::size_t task, const Expected<std::string>& answer) {
        const auto result = answer ? from_bytes(*answer) : Expected<RunResult>(Unexpected(answer.error()));
        if (!result || result->outcome != RunOutcome::passed) {
            const Error& error = result ? result->error : result.error();
            if (!failed)
                failed = {fmt::format("--mutate: '{}' must pass without a change: {}", plan.runs[task].name,
                                      describe(error))};
            return;
        }
        for (const FileCoverage& each : result->coverage) {
            if (each.file == file && each.hash == hash)
                candidates.push_back({&plan.runs[task], result->wall_seconds, each.lines});
        }
    };
    interrupted = run_in_processes(tasks, options.jobs) == PoolEnd::interrupted;
    if (failed) return Unexpected(*failed);
    if (candidates.empty() && !interrupted) return failure("--mutate: no selected scenario loads this file", {file});
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.seconds < b.seconds; });
    return candidates;
}

}  // namespace

std::size_t MutationReport::noticed() const {
    return static_cast<std::size_t>(
        std::count_if(tried.begin(), tried.end(), [](const auto& each) { return each.noticed; }));
}

std::string MutationReport::text() const {
    std::string out;
    std::size_t not_run = 0;
    for (const TriedMutation& each : tried) {
        if (each.noticed) continue;
        not_run += each.is_run ? 0 : 1;
        out += fmt::format("{}:{}: not noticed: {}{}\n", file, each.mutation.line, each.mutation.change,
                           each.is_run ? "" : " (no scenario runs this line)");
    }
    const double share =
        tried.empty() ? 100 : 100.0 * static_cast<double>(noticed()) / static_cast<double>(tried.size());
    out += fmt::format("{}: {} of {} changes noticed ({:.1f} %) by {} run{}", file, noticed(), tried.size(), share,
                       runs, runs == 1 ? "" : "s");
    if (not_run > 0) out += fmt::format("; {} in lines that no scenario runs", not_run);
    return out + "\n";
}

Expected<MutationReport> mutate(const TestPlan& plan, const fs::path& file, const TestSessionOptions& options) {
    for (const PlannedFile& each : plan.files) {
        if (!each.errors.empty()) return Unexpected(each.errors.front());
    }
    const auto text = read_whole(file, file.string());
    if (!text) return Unexpected(text.error());
    std::error_code none;
    const fs::path root = fs::weakly_canonical(Project::of(file, options.installed).root(), none);
    MutationReport report{.file = fs::weakly_canonical(file, none).lexically_relative(root).string()};
    const std::string_view source = without_preamble(*text);
    const std::vector<Mutation> mutations = mutations_of(source);
    if (mutations.empty()) return failure("--mutate: this file contains nothing that can be changed", {file.string()});
    const auto candidates =
        candidates_of(plan, report.file, ScriptFile({"", "", *text}).hash, options, report.interrupted);
    if (!candidates) return Unexpected(candidates.error());
    report.runs = candidates->size();
    for (const Mutation& mutation : mutations) report.tried.push_back({mutation});
    if (report.interrupted) return report;
    PoolTasks tasks;
    tasks.count = mutations.size();
    // Answers with the name of the run that noticed, behind '+' if a run executes the line, else '-'.
    tasks.run = [&](std::size_t task) {
        const Mutation& mutation = mutations[task];
        const ChangedFile changed(file, mutation.of(source));
        TestSessionOptions with_change = options;
        with_change.project_files = &changed;
        std::string answer = "-";
        for (const Candidate& candidate : *candidates) {
            if (!candidate.executes(mutation.statement)) continue;
            answer = "+";
            if (run_planned(plan, *candidate.run, with_change, true).outcome != RunOutcome::passed)
                return answer + candidate.run->name;
        }
        return answer;
    };
    tasks.take = [&](std::size_t task, const Expected<std::string>& answer) {
        TriedMutation& tried = report.tried[task];
        // A crash of the process counts as noticed.
        tried.is_run = !answer || answer->front() == '+';
        tried.noticed = !answer || answer->size() > 1;
        tried.by = answer ? answer->substr(1) : answer.error().message;
    };
    if (options.progress) tasks.progress = [&](std::size_t done) { options.progress(done, tasks.count); };
    report.interrupted = run_in_processes(tasks, options.jobs) == PoolEnd::interrupted;
    return report;
}

}  // namespace nezumi
