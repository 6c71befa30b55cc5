// Files in the order of the paths, scenarios in the order of their files, points in the order of their sweeps.
#include "bindings/scenario/test_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <system_error>

#include "bindings/scenario/scenario_run.hpp"
#include "engine/base/find_files.hpp"
#include "engine/project/near_path.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

std::string text_of_paths(const std::vector<fs::path>& paths) {
    std::string out;
    for (const fs::path& path : paths) out += (out.empty() ? "" : ", ") + path.string();
    return out;
}

std::vector<PlannedRun> runs_of(const Scenario& scenario, std::size_t file, std::size_t index, std::uint64_t seed) {
    std::vector<PlannedRun> runs;
    const bool drawn = scenario.sweep.is_random();
    auto points = drawn ? draws(scenario.sweep, seed_of(seed, scenario.name)) : combinations(scenario.sweep);
    runs.reserve(points.size());
    for (SweepPoint& point : points) runs.push_back({file, index, std::move(point), "", drawn});
    for (PlannedRun& run : runs) run.name = name_of_run(scenario, run.point);
    return runs;
}

// How well a filter fits: a whole name means no other run.
enum class Fit { none, part, whole };

Fit fit(const std::string& filter, const Scenario& scenario, const PlannedRun& run) {
    if (run.name == filter || scenario.name == filter) return Fit::whole;
    return run.name.find(filter) != std::string::npos ? Fit::part : Fit::none;
}

// A point of a random sweep that the filter names, whether or not it is drawn this time.
std::optional<SweepPoint> named_point(const std::string& filter, const Scenario& scenario) {
    const std::string prefix = scenario.name + " ";
    if (!scenario.sweep.is_random() || !filter.starts_with(prefix)) return std::nullopt;
    return find_point(scenario.sweep, std::string_view(filter).substr(prefix.size()));
}

// Where a project keeps its scenarios.
std::vector<fs::path> scenario_folders(const fs::path& root) {
    std::vector<fs::path> folders;
    std::error_code none;
    for (const char* folder : {"tests", "behaviors"}) {
        if (fs::is_directory(root / folder, none)) folders.push_back(root / folder);
    }
    return folders;
}

// Where scenarios are when nobody says where.
fs::path scenario_root(const Project& project) { return project.root().empty() ? fs::current_path() : project.root(); }

Project project_here() { return Project::of(fs::current_path() / "any"); }

}  // namespace

Expected<std::vector<fs::path>> find_scenarios_called(const std::string& name) {
    // "tests/deep/explorer" as well.
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
    // Of a name another name is meant, of a path another path.
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
                "there is no folder tests/ or behaviors/ in {}: say which files or folders to test", root.string()));
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
    // A file that is named twice runs once.
    std::vector<fs::path> once;
    std::vector<fs::path> known;
    for (const fs::path& file : files) {
        const fs::path real = fs::weakly_canonical(file, none);
        if (std::find(known.begin(), known.end(), real) != known.end()) continue;
        known.push_back(real);
        once.push_back(file);
    }
    if (once.empty()) return failure(fmt::format("there is no *_test.lua in {}", text_of_paths(looked)));
    return once;
}

Expected<TestPlan> plan_tests(const PlanOptions& options) {
    const auto paths = find_scenario_files(options.paths);
    if (!paths) return Unexpected(paths.error());
    TestPlan plan;
    std::vector<PlannedRun> part;
    std::vector<PlannedRun> whole;
    std::vector<std::string_view> names;
    for (const fs::path& path : *paths) {
        PlannedFile planned{.path = path, .shown = path.string()};
        auto file = ScenarioFile::read(path, {.installed = options.installed, .seed = options.seed}, &planned.errors);
        if (file) {
            planned.shown = (*file)->shown();
            planned.scenarios = (*file)->scenarios();
        } else {
            planned.shown =
                planned.errors.front().place.file.empty() ? planned.shown : planned.errors.front().place.file;
        }
        plan.files.push_back(std::move(planned));
    }
    for (PlannedFile& file : plan.files) {
        const auto called_so = [&](const PlannedFile& other) { return other.path.stem() == file.path.stem(); };
        file.has_own_stem = std::count_if(plan.files.begin(), plan.files.end(), called_so) == 1;
    }
    for (std::size_t file = 0; file < plan.files.size(); ++file) {
        for (std::size_t i = 0; i < plan.files[file].scenarios.size(); ++i) {
            const Scenario& scenario = plan.files[file].scenarios[i];
            names.emplace_back(scenario.name);
            if (const auto point = named_point(options.filter, scenario)) {
                whole.push_back({file, i, *point, name_of_run(scenario, *point), true});
                continue;
            }
            for (PlannedRun& run : runs_of(scenario, file, i, options.seed)) {
                const Fit fits = options.filter.empty() ? Fit::part : fit(options.filter, scenario, run);
                if (fits == Fit::whole) whole.push_back(run);
                if (fits != Fit::none) part.push_back(std::move(run));
            }
        }
    }
    plan.runs = whole.empty() ? std::move(part) : std::move(whole);
    const bool unread =
        std::any_of(plan.files.begin(), plan.files.end(), [](const auto& f) { return !f.errors.empty(); });
    if (plan.runs.empty() && !unread) {
        return failure(fmt::format("no scenario matches '{}'{}; --list shows all", shown(options.filter),
                                   did_you_mean(options.filter, names)));
    }
    return plan;
}

std::string name_of_run(const Scenario& scenario, const SweepPoint& point) {
    return point.empty() ? scenario.name : scenario.name + " " + text_of(point);
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
