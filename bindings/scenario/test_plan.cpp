// Order of runs: files in the order of the paths, scenarios as in their files, points as in their sweeps.
#include "bindings/scenario/test_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "bindings/scenario/noted_files.hpp"
#include "bindings/scenario/scenario_run.hpp"
#include "engine/base/find_files.hpp"
#include "engine/base/list.hpp"
#include "engine/ports/payload.hpp"
#include "engine/project/folders.hpp"
#include "engine/project/near_path.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

std::string text_of_paths(const std::vector<fs::path>& paths) {
    std::string out;
    for (const fs::path& path : paths) out += (out.empty() ? "" : ", ") + path.string();
    return out;
}

// The repetitions of each combination.
std::vector<Repetition> repetitions(const Scenario& scenario, const std::optional<SeedRange>& seeds) {
    std::vector<Repetition> all;
    if (scenario.seed) return {Repetition{}};
    if (seeds) {
        for (std::uint64_t i = 0; i <= seeds->last - seeds->first; ++i)
            all.push_back({fmt::format(" seed {}", seeds->first + i), seeds->first + i});
        return all;
    }
    for (std::size_t i = 1; i <= scenario.seeds; ++i) all.push_back({.name = fmt::format(" #{}", i)});
    if (all.empty()) all.emplace_back();
    return all;
}

std::string name_of_values(const Scenario& scenario, const SweepPoint& point) {
    return point.empty() ? scenario.name : scenario.name + " " + text_of(point);
}

// Numbers that tables and other programs store exactly.
std::uint64_t seed_of_run(std::uint64_t session, std::string_view name) { return mix(session, name) >> 11; }

// Random draws. In a sweep that is compared in pairs, each draw is made with every value of the key.
std::vector<SweepPoint> drawn_points(const Scenario& scenario, std::uint64_t seed) {
    const std::uint64_t own = seed_of(seed, scenario.name);
    Sweep rest = scenario.sweep, compared;
    const auto is_compared = [&](const SweepKey& key) { return key.name == scenario.paired; };
    const auto key = std::find_if(rest.keys.begin(), rest.keys.end(), is_compared);
    if (key == rest.keys.end()) return draws(rest, own);
    const auto at = key - rest.keys.begin();
    compared.keys.push_back(*key);
    rest.keys.erase(key);
    std::vector<SweepPoint> points;
    for (const SweepPoint& point : draws(rest, own)) {
        for (const SweepPoint& value : combinations(compared)) {
            points.push_back(point);
            points.back().insert(points.back().begin() + at, value.front());
        }
    }
    return points;
}

std::vector<PlannedRun> runs_of(const TestPlan& plan, std::size_t file, std::size_t index,
                                const std::vector<Repetition>& repeated) {
    const Scenario& scenario = plan.files[file].scenarios[index];
    std::vector<PlannedRun> searched;
    for (std::size_t i = 1; i <= scenario.search; ++i) {
        PlannedRun run{.file = file, .scenario = index, .drawn = true, .searched = true};
        run.name = fmt::format("{} [search {}]", scenario.name, i);
        run.seed = scenario.seed.value_or(seed_of_run(plan.seed, run.name));
        searched.push_back(std::move(run));
    }
    if (!searched.empty()) return searched;
    const bool drawn = scenario.sweep.is_random();
    const auto points = drawn ? drawn_points(scenario, plan.seed) : combinations(scenario.sweep);
    std::vector<PlannedRun> runs;
    runs.reserve(points.size() * repeated.size());
    for (const SweepPoint& point : points) {
        for (const Repetition& repetition : repeated) runs.push_back(planned_run(plan, file, index, point, repetition));
    }
    return runs;
}

// How well a filter fits: the whole name of a run selects only this run.
enum class Fit { none, part, whole };

Fit fit(const std::string& filter, const Scenario& scenario, const PlannedRun& run) {
    const std::string_view values = std::string_view(run.name).substr(0, run.name.size() - run.repetition.name.size());
    if (run.name == filter || values == filter || scenario.name == filter) return Fit::whole;
    return run.name.find(filter) != std::string::npos ? Fit::part : Fit::none;
}

// The runs of a random sweep that the filter names, whether or not they would be drawn.
std::vector<PlannedRun> named_runs(const std::string& filter, const TestPlan& plan, std::size_t file, std::size_t index,
                                   const std::vector<Repetition>& repeated) {
    const Scenario& scenario = plan.files[file].scenarios[index];
    const std::string prefix = scenario.name + " ";
    std::vector<PlannedRun> named;
    if ((!scenario.sweep.is_random() && !scenario.draws && scenario.search == 0) || !filter.starts_with(prefix))
        return named;
    const std::string_view values = std::string_view(filter).substr(prefix.size());
    for (const Repetition& repetition : repeated) {
        const auto find = [&scenario](std::string_view text) {
            auto found = find_point(scenario.sweep, text);
            return found || !scenario.draws ? found : find_drawn_point(scenario.sweep, text);
        };
        auto point = find(values);
        if (!point && values.ends_with(repetition.name))
            point = find(values.substr(0, values.size() - repetition.name.size()));
        if (point) named.push_back(planned_run(plan, file, index, std::move(*point), repetition));
    }
    return named;
}

// The folders of a project that can contain scenarios.
std::vector<fs::path> scenario_folders(const fs::path& root) {
    std::vector<fs::path> folders;
    std::error_code none;
    for (const char* folder : {"tests", "behaviors"}) {
        if (fs::is_directory(root / folder, none)) folders.push_back(root / folder);
    }
    return folders;
}

// Scenarios of exercises fail until a pupil has solved them, so they run only where they are named.
bool is_of_exercise(const fs::path& file, const fs::path& root) {
    const fs::path below = file.lexically_relative(root / exercises_folder);
    return !below.empty() && *below.begin() != "..";
}

// Compares the runs in pairs by this key, for every scenario that has it.
Expected<void> pair(TestPlan& plan, const std::string& name) {
    if (name.empty()) return {};
    std::optional<Error> why;
    bool paired = false;
    for (PlannedFile& file : plan.files) {
        for (Scenario& scenario : file.scenarios) {
            const auto fits = check_paired(scenario, name);
            if (fits) {
                scenario.paired = name;
                paired = true;
            } else if (!why || fits.error().message.size() > why->message.size()) {
                why = fits.error();  // the error with a nearest name
            }
        }
    }
    if (paired || !why) return {};
    return failure("--paired: " + why->message);
}

// Lets a search choose the runs of every scenario that draws values.
Expected<void> search(TestPlan& plan, const PlanOptions& options) {
    bool can_search = false, searches = false;
    for (PlannedFile& file : plan.files) {
        for (Scenario& scenario : file.scenarios) {
            const bool draws = scenario.sweep.is_random() || scenario.draws;
            if (options.search > 0 && draws && scenario.paired.empty()) {
                scenario.search = options.search;
                can_search = true;
            }
            searches = searches || scenario.search > 0;
        }
    }
    if (options.search > 0 && !can_search)
        return failure("--search: there is nothing to search: no scenario has a sweep with a range, or s:any");
    if (searches && options.seeds)
        return failure(
            "--seeds: a search chooses its runs itself: leave out --seeds, or choose scenarios without a search by "
            "--filter");
    return {};
}

// The folder of scenarios if no path is given.
fs::path scenario_root(const Project& project) { return project.root().empty() ? fs::current_path() : project.root(); }

// The name must identify a run in results, folders of failures, and --filter.
Expected<void> check_runs(const TestPlan& plan) {
    if (plan.runs.size() > most_runs)
        return failure(
            fmt::format("these are {} runs, more than the limit of {}: choose some by --filter, or fewer seeds",
                        plan.runs.size(), most_runs));
    std::set<std::pair<std::size_t, std::string_view>> names;
    for (const PlannedRun& run : plan.runs) {
        if (names.emplace(run.file, run.name).second) continue;
        const Place& place = plan.files[run.file].scenarios[run.scenario].place;
        return failure(fmt::format("two runs have the name '{}': rename a scenario", shown(run.name)), place);
    }
    return {};
}

Project project_here() { return Project::of(fs::current_path() / "any"); }

}  // namespace

Expected<std::vector<fs::path>> find_scenarios_called(const std::string& name) {
    // Also accepts "tests/deep/explorer".
    std::error_code none;
    const fs::path whole = name + (name.ends_with("_test") ? ".lua" : "_test.lua");
    if (fs::is_regular_file(whole, none)) return std::vector<fs::path>{whole};
    const Project project = project_here();
    std::vector<fs::path> files;
    std::vector<std::string> known;
    for (const fs::path& folder : scenario_folders(scenario_root(project))) {
        for (const fs::path& file : find_files(folder, "_test.lua").files) {
            const std::string stem = file.stem().string();
            known.push_back(stem.substr(0, stem.rfind("_test")));
            if (name == known.back() || name == stem || name == file.filename().string())
                files.push_back(project.shown(file));
        }
    }
    if (!files.empty()) return files;
    // The nearest name for a name, the nearest path for a path.
    std::string near = did_you_mean(name, {known.begin(), known.end()});
    if (fs::path(name).has_parent_path() || name.ends_with(".lua") || near.empty()) {
        if (const std::string path = did_you_mean_path(name); !path.empty()) near = path;
    }
    return failure("there is no such file or folder" + near, {name});
}

Expected<std::vector<fs::path>> find_scenario_files(const std::vector<fs::path>& paths) {
    std::vector<fs::path> files;
    std::error_code none;
    std::vector<fs::path> looked = paths;
    const fs::path root = scenario_root(project_here());
    if (looked.empty()) {
        looked = scenario_folders(root);
        if (looked.empty()) {
            return failure(fmt::format(
                "there is no folder tests/ or behaviors/ in {}: name the files or folders to test", root.string()));
        }
    }
    for (const fs::path& path : looked) {
        if (fs::is_directory(path, none)) {
            const FoundFiles found = find_files(path, "_test.lua");
            if (!found.errors.empty()) return Unexpected(found.errors.front());
            files.insert(files.end(), found.files.begin(), found.files.end());
        } else if (fs::exists(path, none)) {
            files.push_back(path);
        } else {
            auto named = find_scenarios_called(path.string());
            if (!named) return named;
            files.insert(files.end(), named->begin(), named->end());
        }
    }
    if (paths.empty()) std::erase_if(files, [&](const fs::path& file) { return is_of_exercise(file, root); });
    // A file that is named twice runs once.
    std::vector<fs::path> once;
    std::vector<fs::path> known;
    for (const fs::path& file : files) {
        const fs::path real = fs::weakly_canonical(file, none);
        if (contains(known, real)) continue;
        known.push_back(real);
        once.push_back(file);
    }
    if (once.empty()) return failure(fmt::format("there is no *_test.lua in {}", text_of_paths(looked)));
    return once;
}

Expected<TestPlan> plan_tests(const PlanOptions& options) {
    const auto paths = find_scenario_files(options.paths);
    if (!paths) return Unexpected(paths.error());
    TestPlan plan{.seed = options.seed};
    std::vector<PlannedRun> part;
    std::vector<PlannedRun> whole;
    std::vector<std::string_view> names;
    for (const fs::path& path : *paths) {
        PlannedFile planned{.path = path, .shown = path.string()};
        const NotedFiles files(nullptr);
        auto file = ScenarioFile::read(path,
                                       {.installed = options.installed,
                                        .peer_words = options.peer_words,
                                        .seed = options.seed,
                                        .project_files = &files},
                                       &planned.errors);
        planned.looked_for.assign(files.looked_for().begin(), files.looked_for().end());
        if (file) {
            planned.shown = (*file)->shown();
            planned.scenarios = (*file)->scenarios();
        } else {
            planned.shown =
                planned.errors.front().place.file.empty() ? planned.shown : planned.errors.front().place.file;
        }
        plan.files.push_back(std::move(planned));
    }
    if (auto ok = pair(plan, options.paired); !ok) return Unexpected(ok.error());
    if (auto ok = search(plan, options); !ok) return Unexpected(ok.error());
    for (PlannedFile& file : plan.files) {
        const auto called_so = [&](const PlannedFile& other) { return other.path.stem() == file.path.stem(); };
        file.has_own_stem = std::count_if(plan.files.begin(), plan.files.end(), called_so) == 1;
    }
    for (std::size_t file = 0; file < plan.files.size(); ++file) {
        for (std::size_t i = 0; i < plan.files[file].scenarios.size(); ++i) {
            const Scenario& scenario = plan.files[file].scenarios[i];
            names.emplace_back(scenario.name);
            const auto repeated = repetitions(scenario, options.seeds);
            if (auto named = named_runs(options.filter, plan, file, i, repeated); !named.empty()) {
                std::move(named.begin(), named.end(), std::back_inserter(whole));
                continue;
            }
            for (PlannedRun& run : runs_of(plan, file, i, repeated)) {
                const Fit fits = options.filter.empty() ? Fit::part : fit(options.filter, scenario, run);
                if (fits == Fit::whole) whole.push_back(run);
                if (fits != Fit::none) part.push_back(std::move(run));
            }
        }
    }
    plan.runs = whole.empty() ? std::move(part) : std::move(whole);
    if (auto ok = check_runs(plan); !ok) return Unexpected(ok.error());
    const bool unread =
        std::any_of(plan.files.begin(), plan.files.end(), [](const auto& f) { return !f.errors.empty(); });
    if (plan.runs.empty() && !unread) {
        return failure(fmt::format("no scenario matches '{}'{}; --list shows all", shown(options.filter),
                                   did_you_mean(options.filter, names)));
    }
    return plan;
}

PlannedRun planned_run(const TestPlan& plan, std::size_t file, std::size_t scenario, SweepPoint point,
                       const Repetition& repetition) {
    const Scenario& of = plan.files[file].scenarios[scenario];
    PlannedRun run{.file = file, .scenario = scenario, .drawn = of.sweep.is_random(), .repetition = repetition};
    run.name = name_of_values(of, point) + repetition.name;
    const std::string shared = name_of_values(of, without(point, of.paired)) + repetition.name;
    run.seed = of.seed ? *of.seed : repetition.seed.value_or(seed_of_run(plan.seed, shared));
    run.point = std::move(point);
    return run;
}

std::string shell_text(const std::string& argument) {
    const bool plain = !argument.empty() && argument.find_first_not_of(
                                                "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrs"
                                                "tuvwxyz0123456789_./-+=:,@%") == std::string::npos;
    if (plain) return argument;
    std::string out = "'";
    for (const char c : argument) {
        if (c == '\'') {
            out += "'\\''";
        } else {
            out += c;
        }
    }
    return out + "'";
}

}  // namespace nezumi
