// Copies from the system what the returned functions need. They read files only through the snapshot that they get.
#include "engine/live/prepare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "engine/system/script_drivers.hpp"

namespace nezumi {
namespace {

// The names of all components and markers that acts have added; those from a file have a line number.
std::vector<std::string> added_names(const SystemSpec& spec) {
    std::vector<std::string> added;
    for (const Entry& entry : spec.entries) {
        if (place_of(entry).line == 0) added.push_back(name_of(entry));
    }
    for (const MarkerSpec& marker : spec.arena.markers) {
        if (marker.place.line == 0) added.push_back(marker.name);
    }
    return added;
}

bool has(const SystemSpec& spec, const std::string& name) {
    return std::ranges::any_of(spec.entries, [&](const Entry& entry) { return name_of(entry) == name; }) ||
           std::ranges::any_of(spec.arena.markers, [&](const MarkerSpec& marker) { return marker.name == name; });
}

PreparingWork refuse(Error error) {
    return [error = std::move(error)](PreparedAct& prepared, const Project&) { prepared.error = error; };
}

}  // namespace

Expected<const ScriptFile*> script_of(const System& system, const std::string& name) {
    const auto component = system.component(name);
    if (!component) return Unexpected(component.error());
    if (const ScriptFile* file = (*component)->script_file()) return file;
    return failure(fmt::format("{} has no script: only behaviours can be reloaded", name));
}

Expected<SystemSpec> read_spec(const std::filesystem::path& file, const Project& project, const LiveOptions& options) {
    auto spec = options.scripts->read_system(file, project,
                                             {.seed = options.build.seed,
                                              .print = options.print,
                                              .set = options.values.set,
                                              .peer_words = options.peer_words});
    if (spec && options.prepare) {
        if (auto ok = options.prepare(*spec); !ok) return Unexpected(ok.error());
    }
    if (spec) {
        if (auto ok = add_script_drivers(*spec); !ok) return Unexpected(ok.error());
    }
    if (spec) {
        if (auto ok = options.scripts->apply(options.values, *spec, project, options.peer_words); !ok)
            return Unexpected(ok.error());
    }
    return spec;
}

std::unique_ptr<Behaviors> load_behaviors(const SystemSpec& spec, const MakerContext& context, const Project& project,
                                          const LiveOptions& options) {
    auto behaviors = options.scripts->behaviors(options.budget);
    for (const BehaviorEntry* behavior : entries_of<BehaviorEntry>(spec)) behaviors->load(*behavior, context, project);
    // Reads the picture only to note that the file is used: the world reads the picture itself and reports its errors.
    if (spec.arena.floor) static_cast<void>(project.read(spec.arena.floor->image));
    return behaviors;
}

PreparingWork work_of(const Reload& act, const RunningSystem& live, const Reloads& reloads) {
    SourceText source;
    std::vector<ScriptFile> loaded;
    if (!act.files.empty()) {
        // Only these files, and the files that require them.
    } else if (act.component.empty()) {
        loaded = reloads.loaded_files();
    } else {
        const auto file = script_of(live.system(), act.component);
        if (!file) return refuse(file.error());
        source = {(*file)->path, act.shown.empty() ? (*file)->shown : act.shown, act.text};
    }
    return [load = reloads.loader(), source = std::move(source), loaded = std::move(loaded)](PreparedAct& prepared,
                                                                                             const Project& project) {
        auto& files = std::get<Reload>(prepared.act).files;
        const auto read = [&](const std::string& path) { return project.read_source(path); };
        if (!loaded.empty()) files = changed_files(loaded, read);
        prepared.reload = load(files, source, project);
    };
}

PreparingWork work_of(const Add& act, const RunningSystem& live) {
    const auto* robot = std::get_if<RobotEntry>(&act.entry);
    if (live.options().build.real_time && robot != nullptr)
        return refuse({fmt::format("robot '{}': can't be added to a run with --hw: write it in the system file",
                                   name_of(act.entry))});
    SystemSpec part;
    part.file = live.spec().file;
    part.entries.push_back(act.entry);
    if (robot != nullptr) {
        const auto model = live.spec().models.find(robot->described_by());
        if (model != live.spec().models.end()) part.models.insert(*model);
    }
    const System::Settings& settings = live.system().settings();
    return [part = std::move(part), options = live.options(),
            context = MakerContext{.seed = settings.seed, .tick_rate = settings.rate}](PreparedAct& prepared,
                                                                                       const Project& project) {
        prepared.spec = part;
        if (auto* robot = std::get_if<RobotEntry>(&prepared.spec.entries.front())) {
            if (auto ok = options.scripts->read_robot(*robot, prepared.spec, project); !ok) prepared.error = ok.error();
        }
        prepared.behaviors = load_behaviors(prepared.spec, context, project, options);
    };
}

PreparingWork work_of(const Restart& /*act*/, const RunningSystem& live) {
    return [options = live.options(), file = live.file(), now = live.spec()](PreparedAct& prepared,
                                                                             const Project& project) mutable {
        options.print = [&](std::string_view line) { prepared.printed.emplace_back(line); };
        auto spec = file.empty() ? Expected<SystemSpec>(now) : read_spec(file, project, options);
        for (const std::string& name : file.empty() ? std::vector<std::string>() : added_names(now)) {
            if (!spec || !has(*spec, name)) prepared.lost.push_back(name);
        }
        if (!spec) {
            prepared.error = spec.error();
            return;
        }
        prepared.behaviors = load_behaviors(*spec, context_of(*spec, options.build), project, options);
        prepared.spec = std::move(*spec);
    };
}

}  // namespace nezumi
