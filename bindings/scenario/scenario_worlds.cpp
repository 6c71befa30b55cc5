// Builds the worlds of a run from words and from loaded files.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "bindings/lua/files/calibration_file.hpp"
#include "bindings/lua/files/change_robot.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "bindings/scenario/scenario_fields.hpp"
#include "bindings/scenario/scenario_run.hpp"
#include "engine/records/read_record.hpp"
#include "engine/system/script_drivers.hpp"

namespace nezumi {
namespace {

std::size_t count_things(const ArenaSpec& arena) {
    return arena.boxes.size() + arena.cylinders.size() + arena.markers.size() + arena.lines.size() +
           (arena.floor ? 1 : 0) + (arena.size ? 1 : 0);
}

bool says_anything(const SystemSpec& spec) {
    return !spec.entries.empty() || !spec.connections.empty() || count_things(spec.arena) > 0;
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

// Words before `s:load` belong to the world of the loaded file.
void merge(SystemSpec& spec, const SystemSpec& more) {
    append(spec.entries, more.entries);
    append(spec.connections, more.connections);
    append(spec.arena.boxes, more.arena.boxes);
    append(spec.arena.cylinders, more.arena.cylinders);
    append(spec.arena.markers, more.arena.markers);
    append(spec.arena.lines, more.arena.lines);
    if (more.arena.floor) spec.arena.floor = more.arena.floor;
    if (more.arena.size) spec.arena.size = more.arena.size;
    spec.models.insert(more.models.begin(), more.models.end());
    for (const auto& [word, peer] : more.peers) spec.peers.insert_or_assign(word, peer);
    if (!more.rate_place.file.empty()) {
        spec.rate = more.rate;
        spec.rate_place = more.rate_place;
    }
}

// Applies the options of `s:load(file, { robots = { mouse = { noise = 0.05 } } })`.
Expected<void> change_robots(SystemSpec& spec, const Value& options, const Project& project, const Place& place) {
    FieldCheck check("load", "load", place, nullptr, "option");
    Fields fields(check, options);
    LoadOptions load;
    read_record(fields, load);
    Fields robots = fields.inner("robots");
    for (const FileField& each : robots.all()) {
        robots.field(each.name);
        FieldCheck fits(fmt::format("load: robot '{}'", shown(each.name)), "load", place, nullptr);
        if (auto changed = change_robot(spec, each.name, each.value, fits, project); !changed) {
            const Error& error = changed.error();
            return error.place.file.empty() ? failure("load: " + error.message, place) : changed;
        }
        if (auto ok = fits.result(); !ok) return ok;
    }
    robots.done();
    fields.done();
    return check.result();
}

}  // namespace

ScenarioRun::Described::Fixed ScenarioRun::Described::Fixed::of(const SystemSpec& spec) {
    return {count_things(spec.arena), spec.rate, spec.physics_step};
}

ScenarioRun::Described& ScenarioRun::described() {
    if (described_.empty()) {
        Described first;
        first.project = std::make_unique<Project>(file_.project());
        first.words = std::make_unique<SystemWords>(*first.project, file_.peer_words());
        first.words->spec().file = file_.shown();
        described_.push_back(std::move(first));
        word_host_.words = described_.back().words.get();
    }
    return described_.back();
}

Expected<void> ScenarioRun::settle() {
    if (described_.empty()) return {};
    Described& present = described_.back();
    const SystemSpec& spec = present.words->spec();
    if (present.live == nullptr) {
        if (!says_anything(spec)) return {};
        if (auto ok = present.words->finish(); !ok) return ok;
        if (auto ok = use_asked_calibrations(present.words->spec(), *present.project); !ok) return ok;
        return build(present);
    }
    const bool must_rebuild = Described::Fixed::of(spec) != present.fixed;
    if (!must_rebuild && spec.entries.size() == present.entries && spec.connections.size() == present.connections)
        return {};
    if (auto ok = present.words->finish(); !ok) return ok;
    return must_rebuild ? rebuild(present) : add_new(present);
}

// A world that can't be built ends the run with `could_not_run`.
Expected<void> ScenarioRun::settle_or_note() {
    auto settled = settle();
    if (!settled) {
        setup_error_ = settled.error();
        setup_error_->message = one_line(setup_error_->message);
        return Unexpected(*setup_error_);
    }
    return {};
}

LiveOptions ScenarioRun::world_options() {
    LiveOptions options = settings_.systems();
    options.build.seed = settings_.seed;
    options.build.seed_wins = true;
    if (!options.build.real_time) {
        options.build.out_of_time_is_fatal = true;
        options.budget = headless_budget;
    }
    if (covered_scripts_ != nullptr) options.scripts = covered_scripts_.get();
    options.watch = false;
    options.files = &file_.project().files();
    options.print = [this](std::string_view line) { print(line); };
    options.build.log = [this](const LogLine& line) {
        if (settings_.spectator != nullptr) settings_.spectator->log(line);
        if (line.level == LogLevel::debug) return;
        const std::string who = line.component.empty() ? "" : line.component + ": ";
        print(fmt::format("[{:8.3f}] {} {}{}", line.seconds, to_text(line.level), who, line.text));
    };
    return options;
}

RunningSystem& ScenarioRun::current() {
    const bool is_described = !described_.empty() && described_.back().live != nullptr;
    return is_described ? *described_.back().live : worlds_[worlds_.size() - 1];
}

// Adds the drivers that are scripts. Their components depend on whether the robot is real.
Expected<void> ScenarioRun::add_drivers(SystemSpec& spec) {
    const bool has_script = std::any_of(spec.models.begin(), spec.models.end(),
                                        [](const auto& model) { return !model.second.hardware.script.empty(); });
    const LiveOptions options = world_options();
    if (has_script && options.prepare) {
        if (auto ready = options.prepare(spec); !ready) return ready;
    }
    return add_script_drivers(spec);
}

Expected<void> ScenarioRun::build(Described& described) {
    LiveOptions options = world_options();
    if (options.build.real_time && !worlds_.empty())
        return failure("with --hw a scenario can have only one world: remove the second world");
    SystemSpec spec = described.words->spec();
    if (options.prepare) {
        if (auto ready = options.prepare(spec); !ready) return ready;
    }
    std::unique_ptr<RunningSystem> from_text = load_from_text(described, options);
    const bool is_journaled = from_text != nullptr;
    auto live = is_journaled ? Expected<std::unique_ptr<RunningSystem>>(std::move(from_text))
                             : RunningSystem::make(std::move(spec), *described.project, std::move(options));
    if (!live) return Unexpected(live.error());
    const SystemSpec& built = described.words->spec();
    described.entries = built.entries.size();
    described.connections = built.connections.size();
    described.fixed = Described::Fixed::of(built);
    described.live = &worlds_.add(std::move(*live));
    if (settings_.files != nullptr) settings_.files->begin(worlds_.size() - 1, *described.live, is_journaled);
    described.live->activate();
    return {};
}

// Writes the system as text and builds the world from it, because a journal begins with a system file. Null if
// impossible.
std::unique_ptr<RunningSystem> ScenarioRun::load_from_text(const Described& described, const LiveOptions& options) {
    namespace fs = std::filesystem;
    if (!settings_.keep_journal || options.build.real_time) return nullptr;
    const SystemSpec& spec = described.words->spec();
    const fs::path root = described.project->root();
    const ProjectFiles& files = *options.files;
    // The files of the system are searched from the folder of the described file, as before.
    const auto full = [&](const fs::path& path) { return (files.working_folder() / path).lexically_normal(); };
    fs::path folder = full(fs::path(spec.file).parent_path());
    const bool is_in_project = root.empty() || folder.string().starts_with(full(root).string());
    if (!is_in_project) folder = full(fs::path(file_.shown()).parent_path());
    texts_.emplace_back(files, folder / "scenario's system.lua",
                        options.scripts->write_system_text(spec, "The system of a scenario."));
    LiveOptions own = options;
    own.files = &texts_.back();
    auto live = RunningSystem::load(texts_.back().path(), std::move(own));
    return live ? std::move(*live) : nullptr;
}

Expected<void> ScenarioRun::rebuild(Described& described) {
    const auto world = described_.size() - 1;
    const SystemSpec& spec = described.words->spec();
    const Described::Fixed now = Described::Fixed::of(spec);
    const char* word = now.rate != described.fixed.rate                   ? "rate"
                       : now.physics_step != described.fixed.physics_step ? "physics"
                                                                          : "arena";
    if (worlds_.ticks(world) > 0) {
        return failure(
            fmt::format("{}: can't change after time has passed: call it before s:run and all methods that wait", word),
            word_host_.called);
    }
    if (described.live->options().build.real_time)
        return failure(
            fmt::format("{}: with --hw, call it before the scenario reads or changes anything in the system", word),
            word_host_.called);
    if (auto ok = described.live->rebuild(spec); !ok) return ok;
    if (settings_.files != nullptr) settings_.files->drop_journal(world);
    described.entries = spec.entries.size();
    described.connections = spec.connections.size();
    described.fixed = Described::Fixed::of(spec);
    return {};
}

Expected<void> ScenarioRun::add_new(Described& described) {
    const SystemSpec& spec = described.words->spec();
    RunningSystem& live = *described.live;
    while (described.entries < spec.entries.size()) {
        const Entry& entry = spec.entries[described.entries++];
        if (live.options().build.real_time && std::holds_alternative<RobotEntry>(entry))
            return failure(fmt::format("robot '{}': with --hw, declare all robots before the scenario reads or changes "
                                       "anything in the system",
                                       name_of(entry)),
                           place_of(entry));
        if (auto added = live.act(Add{entry}, scenario_actor); !added) return Unexpected(added.error());
        // A component that can't be activated is in ERROR, as at the start of a system.
        if (std::visit([](const auto& e) { return e.active; }, entry))
            static_cast<void>(live.act(Activate{name_of(entry)}, scenario_actor));
    }
    while (described.connections < spec.connections.size()) {
        const ConnectionSpec& connection = spec.connections[described.connections++];
        if (auto ok = live.act(Connect{connection.from, connection.to}, scenario_actor); !ok)
            return failure(ok.error().message, connection.place);
    }
    return {};
}

Expected<void> ScenarioRun::load(const std::string& name, const Expected<Value>& options, const Place& place) {
    if (!options) return failure("load: " + options.error().message, place);
    SystemSpec before;
    if (!described_.empty()) {
        if (described_.back().live != nullptr) {
            if (auto ok = settle(); !ok) return ok;
        } else {
            before = described_.back().words->spec();
        }
    }
    const auto path = file_.project().find(FileKind::system, name, place.file);
    if (!path) return failure("load: " + path.error().message, place);
    // A system of another project is read as part of that project. Additions of the scenario belong to the scenario's
    // project.
    const Project theirs = Project::of(*path, file_.project().installed(), file_.project().files());
    auto spec = read_system_file(*path, theirs,
                                 {.seed = settings_.seed,
                                  .print = [this](std::string_view line) { print(line); },
                                  .peer_words = file_.peer_words()});
    if (!spec) return Unexpected(spec.error());
    if (auto ok = change_robots(*spec, *options, theirs, place); !ok) return ok;
    if (auto ok = add_drivers(*spec); !ok) return ok;
    merge(*spec, before);
    Described next;
    next.project = std::make_unique<Project>(file_.project().root().empty() ? theirs : file_.project());
    next.words = std::make_unique<SystemWords>(*next.project, file_.peer_words(), std::move(*spec));
    if (auto ok = next.words->finish(); !ok) return ok;
    if (auto ok = build(next); !ok) return ok;
    if (!described_.empty() && described_.back().live == nullptr) {
        described_.back() = std::move(next);
    } else {
        described_.push_back(std::move(next));
    }
    word_host_.words = described_.back().words.get();
    return {};
}

}  // namespace nezumi
