// A failed run is repeated, with all its data recorded.
#include "bindings/scenario/planned_run.hpp"

#include <fmt/format.h>

#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "bindings/scenario/failure_folder.hpp"
#include "bindings/scenario/margins.hpp"
#include "bindings/scenario/noted_files.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

RunResult run_once(const PlannedFile& file, const PlannedRun& run, const TestSessionOptions& options, RunFiles* files,
                   bool keep_history, bool keep_journal) {
    std::optional<Coverage> coverage;
    if (options.coverage) coverage.emplace(Project::of(file.path, options.installed).root());
    Coverage* const covered = coverage ? &*coverage : nullptr;
    const NotedFiles files_of_project(options.project_files);
    auto read = ScenarioFile::read(file.path, {.installed = options.installed,
                                               .peer_words = options.peer_words,
                                               .seed = options.seed,
                                               .coverage = covered,
                                               .project_files = &files_of_project,
                                               .only = run.scenario});
    const auto reads = [&files_of_project] {
        const std::set<std::string>& all = files_of_project.looked_for();
        return std::vector<std::string>(all.begin(), all.end());
    };
    if (!read) return {.outcome = RunOutcome::could_not_run, .error = read.error(), .reads = reads()};
    if (run.scenario >= (*read)->scenarios().size())
        return {.outcome = RunOutcome::could_not_run, .error = {"the file has changed meanwhile", {file.shown}}};
    ScenarioRun scenario(**read, run.scenario,
                         {.seed = run.seed,
                          .point = run.point,
                          .name = run.name,
                          .systems = options.systems,
                          .recordings = options.recordings,
                          .files = files,
                          .keep_journal = keep_journal,
                          .keep_history = keep_history,
                          .update_goldens = options.update_goldens,
                          .spectator = options.spectator,
                          .coverage = covered});
    RunResult result = scenario.run();
    // Includes files that failed to load, and missing files: saving them may correct the run.
    const std::vector<std::string> looked_for = reads();
    result.reads.insert(result.reads.end(), looked_for.begin(), looked_for.end());
    return result;
}

std::string command_for(const PlannedFile& file, const PlannedRun& run, const TestSessionOptions& options) {
    const auto& given = run.repetition.seed;
    const std::string seed = given ? fmt::format("--seeds {0}..{0}", *given) : fmt::format("--seed {}", options.seed);
    return fmt::format("nezumi test {} --filter {} {}{}", shell_text(file.shown), shell_text(run.name), seed,
                       options.words);
}

// How two results of one run differ: by their hashes, or by their outcomes if the hashes are equal.
std::string difference_of(std::string_view name, const RunResult& result, std::string_view other_name,
                          const RunResult& other) {
    if (result.hash != other.hash)
        return fmt::format("{} has hash {:016x}, {} has hash {:016x}", name, result.hash, other_name, other.hash);
    const auto outcome = [](const RunResult& of) {
        return of.outcome == RunOutcome::passed   ? "passed"
               : of.outcome == RunOutcome::failed ? "failed"
                                                  : "could not run";
    };
    return fmt::format("{} {}, {} {}", name, outcome(result), other_name, outcome(other));
}

}  // namespace

RunResult agree(std::vector<RunResult> results, const Place& place) {
    RunResult first = results.front();
    for (std::size_t i = 1; i < results.size(); ++i) {
        if (results[i].hash == first.hash && results[i].outcome == first.outcome) continue;
        if (first.outcome == RunOutcome::could_not_run) break;
        if (results[i].outcome == RunOutcome::could_not_run) return std::move(results[i]);
        first.error = {fmt::format("repetitions of this run differ: {}",
                                   difference_of("the first", first, fmt::format("number {}", i + 1), results[i])),
                       place};
        first.outcome = RunOutcome::failed;
        break;
    }
    return first;
}

RunReport report_of(const TestPlan& plan, const PlannedRun& run, RunResult result, const TestSessionOptions& options) {
    const PlannedFile& file = plan.files[run.file];
    const Scenario& scenario = file.scenarios[run.scenario];
    return {
        scenario.place.file, scenario.place.line, scenario.name, run.name, run.seed, command_for(file, run, options),
        std::move(result)};
}

RunResult run_planned(const TestPlan& plan, const PlannedRun& run, const TestSessionOptions& options, bool quick) {
    const PlannedFile& file = plan.files[run.file];
    std::optional<RunResult> first;
    if (quick || !options.is_real) first = run_once(file, run, options, nullptr, false, false);
    if (first && (quick || first->outcome != RunOutcome::failed)) return std::move(*first);
    const auto folder = make_failure_folder(options.folder / run_file_name(file.shown, run.name, file.has_own_stem));
    std::unique_ptr<RunFiles> files;
    if (folder && options.files) files = options.files(*folder);
    RunResult again = run_once(file, run, options, files.get(), true, first.has_value());
    // A world that is built from text, for the journal, may differ: the run is made again without the journal.
    if (first && folder && (again.hash != first->hash || again.outcome != first->outcome)) {
        if (options.files) files = options.files(*make_failure_folder(*folder));
        again = run_once(file, run, options, files.get(), true, false);
    }
    if (first) {
        if (again.outcome != first->outcome || again.hash != first->hash)
            again.facts.push_back("the repeated run differs: " +
                                  difference_of("the first run", *first, "the repeated one", again));
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
    text += fmt::format("the session's seed: {}\n", options.seed);
    for (const std::string& line : again.printed) text += "| " + line + "\n";
    if (!again.margins.empty()) text += fmt::format("{}\n", conditions_heading);
    for (const ConditionMargin& margin : again.margins) text += "  " + text_of(margin) + "\n";
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

}  // namespace nezumi
