// Builds the next system beside the running one, which is replaced only after success.
#include "engine/live/running_system.hpp"

#include <fmt/format.h>

#include "engine/live/answer_question.hpp"
#include "engine/live/prepare.hpp"
#include "engine/live/running.hpp"
#include "engine/time/recorded_files.hpp"

namespace nezumi {
namespace {

// The interval of hashes in a history.
constexpr std::int64_t ticks_between_hashes = 100;

}  // namespace

Expected<std::unique_ptr<RunningSystem>> RunningSystem::load(const std::filesystem::path& file, LiveOptions options) {
    FileSnapshot files(*options.files);
    const Project project = Project::of(file, options.installed, files);
    auto spec = read_spec(file, project, options);
    if (!spec) return Unexpected(spec.error());
    Project lasting = project.through(*options.files);
    auto live = make(std::move(*spec), std::move(lasting), std::move(options), files);
    if (live) (*live)->file_ = file;
    return live;
}

Expected<std::unique_ptr<RunningSystem>> RunningSystem::make(SystemSpec spec, Project project, LiveOptions options) {
    FileSnapshot files(project.files());
    return make(std::move(spec), std::move(project), std::move(options), files);
}

Expected<std::unique_ptr<RunningSystem>> RunningSystem::make(SystemSpec spec, Project project, LiveOptions options,
                                                             FileSnapshot& files) {
    auto live = std::unique_ptr<RunningSystem>(new RunningSystem(std::move(project), std::move(options)));
    auto running = live->build(std::move(spec), files);
    if (!running) return Unexpected(running.error());
    live->take(std::move(*running));
    live->history_.begin(files.take());
    if (live->options_.build.real_time) live->history_.cut();  // real robots can't go back
    return live;
}

RunningSystem::RunningSystem(Project project, LiveOptions options)
    : project_(std::move(project)), options_(std::move(options)) {}

RunningSystem::~RunningSystem() = default;

Expected<std::unique_ptr<RunningSystem::Running>> RunningSystem::build(SystemSpec spec, const FileSnapshot& files) {
    auto behaviors = load_behaviors(spec, context_of(spec, options_.build), project_.through(files), options_);
    return build(std::move(spec), std::move(behaviors), files);
}

Expected<std::unique_ptr<RunningSystem::Running>> RunningSystem::build(SystemSpec spec,
                                                                       std::unique_ptr<Behaviors> behaviors,
                                                                       const ProjectFiles& files) {
    auto next = std::make_unique<Running>();
    next->spec = std::move(spec);
    // A repeated run uses the pictures of the original run.
    const bool is_of_disk = !repeats_ && options_.files == &disk();
    next->makers.world = is_of_disk ? options_.world : with_pictures_from(files, options_.world);
    next->makers.bodies = options_.bodies;
    next->makers.drivers = options_.drivers;
    next->makers.rig = options_.rig;
    next->makers.network = options_.network;
    next->makers.components = options_.components;
    next->makers.peer_words = options_.peer_words;
    next->behaviors = std::move(behaviors);
    next->makers.behavior = [&all = *next->behaviors](const BehaviorEntry& entry, const MakerContext&) {
        return all.take(entry);
    };
    next->log = options_.build.log;
    next->start = starts_ + 1;
    BuildOptions options = options_.build;
    options.log = [running = next.get()](LogLine line) {
        line.start = running->start;
        if (running->log) running->log(line);
    };
    auto system = build_system(next->spec, next->makers, options);
    if (!system) return Unexpected(system.error());
    next->system = std::move(*system);
    next->reloads = next->behaviors->reloads_of(*next->system);
    return next;
}

std::unique_ptr<RunningSystem::Running> RunningSystem::replace(std::unique_ptr<Running> running) {
    std::swap(running_, running);
    endings_.clear();
    ++generation_;
    return running;
}

std::unique_ptr<RunningSystem::Running> RunningSystem::take(std::unique_ptr<Running> next) {
    std::unique_ptr<Running> running = replace(std::move(next));
    running_->system->observe(running_->hash);
    trace_.start(*running_->system);
    if (options_.watch) running_->live_reload.emplace(*this, *running_->reloads, running_->spec.files);
    ++starts_;
    if (!foreseen_.empty()) take_foreseen();
    if (running != nullptr && running->system->is_stopped()) {
        running_->system->emergency_stop();
        running_->system->log(LogLevel::warn,
                              "the emergency stop is still active: rearm() lets the robots drive again");
    }
    return running;
}

void RunningSystem::activate() {
    if (!foreseen_.empty()) take_foreseen();
    activate_all(*running_->system, running_->spec);
}

void RunningSystem::between_ticks() {
    running_->reloads->after_tick();
    if (running_->live_reload) running_->live_reload->between_ticks();
    if (Network* network = running_->system->network()) {
        network->between_ticks(door(), [this](const Question& question, bool writable, const Actor& who) {
            return answer_question({tree(), trace_, door()}, question, writable, who);
        });
    }
}

bool RunningSystem::may_tick() {
    Network* network = running_->system->network();
    return network == nullptr || network->may_tick();
}

void RunningSystem::add_files(std::vector<int>& files) const {
    if (const Network* network = system().network()) network->add_files(files);
}

ActDoor RunningSystem::door() {
    return [this](const Act& each, const Actor& who) { return act(each, who); };
}

void RunningSystem::tick() {
    if (away_ != nullptr && history_.current() == away_->branch && !is_earlier(when(), away_->when)) {
        // Comes back by an act, so that a journal has it before the messages that arrive now.
        static_cast<void>(act(back(), {Actor::Kind::run, ""}));
    }
    between_ticks();
    if (Network* network = running_->system->network()) {
        network->before_tick(
            [this](const Port& port, const Act& each, const Actor& who) { return deliver(port, each, who); });
    }
    if (!endings_.empty()) end_holds();
    if (!foreseen_.empty()) take_foreseen();
    if (!ended_) repeat_known();
    if (!gone_.empty() && !is_past()) {
        for (const Actor& who : std::exchange(gone_, {})) let_go(who);
    }
    const ActTime time = when();
    running_->system->tick();
    tell_out_of_time(time);
    if (remembered_ && !ended_) remembered_->note(history_.current(), when(), generation_, system());
    if (ended_) {
        // Nothing is repeated or recorded: ticks after the end differ from the original ticks after this moment.
    } else if (is_past()) {
        repeat_known(false);
    } else if (!history_.is_cut() && running_->system->now().tick % ticks_between_hashes == 0) {
        history_.add({when(), PastHash{trace_hash()}});
    }
    // The result is not checked: an emergency stop is never refused.
    for (const auto& component : running_->system->components()) {
        if (component->take_stop()) static_cast<void>(act(Stop{}, {Actor::Kind::joystick, component->name()}));
    }
}

ActTime RunningSystem::when() const { return {starts_, running_->system->now().tick, acts_}; }

void RunningSystem::let_go(const Actor& who) {
    if (is_past()) return gone_.push_back(who);  // later: an act now would begin a branch
    for (const std::string& path : running_->system->held_by(who)) {
        const auto port = running_->system->port(path);
        if (port && (*port)->type() == message_of<Velocity2D>()) {
            static_cast<void>(act(Hold{path, Velocity2D{}}, who));
            endings_.push_back({path, who, running_->system->now().tick});
        } else {
            static_cast<void>(act(Release{path}, who));
        }
    }
}

void RunningSystem::end_holds() {
    const std::int64_t tick = running_->system->now().tick;
    for (const Ending& ending : std::exchange(endings_, {})) {
        const Actor* holder = running_->system->holder(ending.port);
        const bool is_its = holder != nullptr && *holder == ending.who;
        if (tick <= ending.tick) {
            endings_.push_back(ending);
        } else if (is_its) {
            static_cast<void>(act(Release{ending.port}, ending.who));
        }
    }
}

void RunningSystem::take_foreseen() {
    const Time& now = running_->system->now();
    std::erase_if(foreseen_, [&](const Foreseen& each) {
        if (each.start != starts_ || each.tick != now.tick) return false;
        Component* component = running_->system->find(each.component);
        if (component != nullptr) component->run_out_of_time_at(each.call);
        return component != nullptr;
    });
}

void RunningSystem::tell_out_of_time(const ActTime& time) {
    for (const auto& component : running_->system->components()) {
        if (!component->has_new_out_of_time()) continue;
        for (auto& call : component->take_out_of_time()) {
            if (repeats_ || history_.is_past(time)) continue;
            if (act_observer_ != nullptr) act_observer_->ran_out_of_time(time, component->name(), call);
            history_.add({time, std::make_shared<const PastCall>(PastCall{component->name(), std::move(call)})});
        }
    }
}

Expected<void> RunningSystem::rebuild(SystemSpec spec) {
    FileSnapshot files(project_.files());
    auto next = build(std::move(spec), files);
    if (!next) return Unexpected(next.error());
    const std::unique_ptr<Running> before = take(std::move(*next));
    activate();
    for (const auto& component : before->system->components()) {
        if (Component* same = running_->system->find(component->name())) same->parameters() = component->parameters();
    }
    return {};
}

Expected<std::int64_t> RunningSystem::explain_next(std::string_view name) {
    const auto component = running_->system->component(name);
    if (!component) return Unexpected(component.error());
    if ((*component)->script_file() == nullptr)
        return failure(fmt::format("{} is not a behaviour: it has no lines", name));
    if ((*component)->state() != LifeState::active)
        return failure(
            fmt::format("{} is {}: only ACTIVE components are executed", name, to_text((*component)->state())));
    return (*component)->trace_next();
}

Expected<std::optional<Explanation>> RunningSystem::explanation(std::string_view name, std::int64_t trace) const {
    const Component* const component = system().find(name);
    if (component == nullptr || component->script_file() == nullptr) return failure(fmt::format("{} is gone", name));
    if (component->traces() < trace) return std::optional<Explanation>();
    return std::optional(explain(system(), *component));
}

void RunningSystem::set_at_rest(bool at_rest) { running_->system->set_at_rest(at_rest); }

void RunningSystem::halt() {
    for (Robot* robot : running_->system->robots()) robot->halt();
}

void RunningSystem::end() {
    for (const Running* each : {running_.get(), away_ ? away_->running.get() : nullptr}) {
        if (each == nullptr) continue;
        if (Network* network = each->system->network()) network->leave();
        each->system->stop(0);
    }
    ended_ = true;
}

const System& RunningSystem::system() const { return *running_->system; }
const SystemSpec& RunningSystem::spec() const { return running_->spec; }
std::uint64_t RunningSystem::trace_hash() const {
    const std::uint64_t hash = running_->hash.value();
    return hash_before_ ? mix(*hash_before_, hash) : hash;
}

void RunningSystem::watch_again() {
    if (running_->live_reload) running_->live_reload->watch_again();
}

}  // namespace nezumi
