// Builds beside the system that runs, and takes its place only when all has gone well.
#include "bindings/lua/live/live_system.hpp"

#include <optional>
#include <utility>

#include "bindings/lua/files/system_file.hpp"

namespace nezumi {

// All that a restart replaces. Declaration order is destruction order reversed.
struct LiveSystem::Running {
    SystemSpec spec;
    ChunkCache chunks;
    Makers makers;
    std::unique_ptr<System> system;
    TraceHash hash;
    std::optional<Reloader> reloader;
    std::optional<LiveReload> live_reload;
};

namespace {

Expected<SystemSpec> read_spec(const std::filesystem::path& file, const Project& project, const LiveOptions& options) {
    return read_system_file(file, project, {.seed = options.build.seed, .print = options.print});
}

}  // namespace

Expected<std::unique_ptr<LiveSystem>> LiveSystem::load(const std::filesystem::path& file, LiveOptions options) {
    Project project = Project::of(file, options.installed);
    auto spec = read_spec(file, project, options);
    if (!spec) return Unexpected(spec.error());
    auto live = make(std::move(*spec), std::move(project), std::move(options));
    if (live) (*live)->file_ = file;
    return live;
}

Expected<std::unique_ptr<LiveSystem>> LiveSystem::make(SystemSpec spec, Project project, LiveOptions options) {
    auto live = std::unique_ptr<LiveSystem>(new LiveSystem(std::move(project), std::move(options)));
    auto running = live->build(std::move(spec));
    if (!running) return Unexpected(running.error());
    live->take(std::move(*running));
    return live;
}

LiveSystem::LiveSystem(Project project, LiveOptions options)
    : project_(std::move(project)), options_(std::move(options)) {}

LiveSystem::~LiveSystem() = default;

Expected<std::unique_ptr<LiveSystem::Running>> LiveSystem::build(SystemSpec spec) {
    auto next = std::make_unique<Running>();
    next->spec = std::move(spec);
    next->makers.world = options_.world;
    next->makers.bodies = options_.bodies;
    next->makers.components = options_.components;
    next->makers.behavior =
        [settings = BehaviorSettings{.project = project_, .budget = options_.budget, .chunks = &next->chunks}](
            const BehaviorEntry& entry, const MakerContext& context) {
            return make_behavior(entry, context, settings);
        };
    BuildOptions options = options_.build;
    options.log = [log = options_.build.log, start = starts_ + 1](LogLine line) {
        line.start = start;
        if (log) log(line);
    };
    auto system = build_system(next->spec, next->makers, options);
    if (!system) return Unexpected(system.error());
    next->system = std::move(*system);
    next->reloader.emplace(*next->system);
    return next;
}

void LiveSystem::take(std::unique_ptr<Running> running) {
    running_ = std::move(running);
    running_->system->observe(running_->hash);
    trace_.start(*running_->system);
    if (options_.watch) running_->live_reload.emplace(*running_->system, *running_->reloader, running_->spec.files);
    ++starts_;
}

void LiveSystem::activate() { activate_all(*running_->system, running_->spec); }

void LiveSystem::between_ticks() {
    if (running_->live_reload) {
        running_->live_reload->between_ticks();
    } else {
        running_->reloader->after_tick();
    }
}

void LiveSystem::tick() {
    between_ticks();
    running_->system->tick();
}

Expected<void> LiveSystem::restart() {
    Expected<SystemSpec> spec = running_->spec;
    if (!file_.empty()) spec = read_spec(file_, project_, options_);
    if (!spec) return Unexpected(spec.error());
    return restart_as(std::move(*spec));
}

Expected<void> LiveSystem::restart_as(SystemSpec spec) {
    auto next = build(std::move(spec));
    if (!next) return Unexpected(next.error());
    take(std::move(*next));
    activate();
    return {};
}

Expected<Component*> LiveSystem::add(const Entry& entry, const SystemSpec& spec) {
    SystemSpec& ours = running_->spec;
    if (const auto* robot = std::get_if<RobotEntry>(&entry)) {
        if (const auto model = spec.models.find(robot->model); model != spec.models.end()) ours.models.insert(*model);
    }
    auto added = add_entry(*running_->system, entry, ours, running_->makers);
    if (!added) return added;
    ours.entries.push_back(entry);
    watch_again();
    return added;
}

System& LiveSystem::system() { return *running_->system; }
const System& LiveSystem::system() const { return *running_->system; }
Reloader& LiveSystem::reloader() { return *running_->reloader; }
const SystemSpec& LiveSystem::spec() const { return running_->spec; }
std::uint64_t LiveSystem::trace_hash() const { return running_->hash.value(); }

void LiveSystem::watch_again() {
    if (running_->live_reload) running_->live_reload->watch_again();
}

}  // namespace nezumi
