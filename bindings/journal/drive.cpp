// The recorded messages come from a device whose out-ports are connected to the behaviour.
#include "bindings/journal/drive.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace nezumi {
namespace {

// The name of the device that plays the recording. The judged system has no other component with this name.
std::string player_of(const std::string& behavior) { return behavior + "_recording"; }

// Keeps the acts on one component, until the run restarts or goes back.
class ActKeeper final : public ActObserver {
public:
    ActKeeper(RecordedDrive& drive, const RunningSystem& live)
        : drive_(drive), live_(live), generation_(live.generation()) {}
    void acted(const ActTime& when, std::shared_ptr<const PastAct> act, const Expected<ActResult>& result) override {
        if (result && live_.generation() == generation_ && is_about(act->act, drive_.entry.name))
            drive_.acts.emplace_back(when.tick, act->act);
    }
    void ran_out_of_time(const ActTime&, const std::string&, const Component::OutOfTime&) override {}

private:
    RecordedDrive& drive_;
    const RunningSystem& live_;
    const int generation_;
};

// Finds the last message of a port in each tick. Ticks must be requested in ascending order.
class Cursor {
public:
    explicit Cursor(const DrivePort* port) : port_(port) {}
    const Value* at(std::int64_t tick) {
        const Value* found = nullptr;
        for (; next_ < port_->messages.size() && port_->messages[next_].first <= tick; ++next_) {
            if (port_->messages[next_].first == tick) found = &port_->messages[next_].second.data;
        }
        return found;
    }

private:
    const DrivePort* port_;
    std::size_t next_ = 0;
};

class Judge {
public:
    Judge(const RecordedDrive& drive, double tolerance, Judgement& judgement, JudgedCurves* curves)
        : drive_(drive), tolerance_(tolerance), judgement_(judgement), curves_(curves) {}

    void follow(const Component& behavior) {
        for (const auto& [name, port] : drive_.published) ports_.push_back({name, Cursor(&port)});
        for (const auto& port : behavior.out_ports()) {
            if (drive_.published.contains(port->name())) continue;
            judgement_.notes.push_back(
                fmt::format("output '{}' is not in the recording: it is not compared", port->name()));
        }
    }

    // Returns whether anything differs in this tick.
    bool compare(const Component& behavior, const Time& now) {
        bool differs = false;
        for (auto& [name, recorded] : ports_) {
            const Value* then = recorded.at(now.tick);
            const OutPortBase* port = behavior.find_out_port(name);
            std::optional<Value> written;
            if (port != nullptr && port->latched_tick() == now.tick) written = port->value();
            const std::string full = behavior.name() + "." + name;
            if (curves_ != nullptr && then != nullptr) curves_->then.add(full, *then, now.seconds);
            if (curves_ != nullptr && written) curves_->now.add(full, *written, now.seconds);
            for (DifferingValue& each : differing_values(full, then, written ? &*written : nullptr, tolerance_)) {
                add(std::move(each), now);
                differs = true;
            }
        }
        judgement_.different += differs ? 1 : 0;
        return differs;
    }

private:
    void add(DifferingValue value, const Time& time) {
        auto field = std::find_if(judgement_.fields.begin(), judgement_.fields.end(),
                                  [&](const JudgedField& each) { return each.name == value.name; });
        if (field == judgement_.fields.end()) field = judgement_.fields.insert(field, JudgedField{.name = value.name});
        ++field->ticks;
        if (value.by && !(*value.by <= field->largest)) {
            field->largest = *value.by;
            field->largest_at = time.seconds;
        }
        if (judgement_.first.empty() || judgement_.first_tick == time.tick) {
            judgement_.first_tick = time.tick;
            judgement_.first_at = time.seconds;
            judgement_.first.push_back(std::move(value));
        }
    }

    const RecordedDrive& drive_;
    const double tolerance_;
    Judgement& judgement_;
    JudgedCurves* const curves_;
    std::vector<std::pair<std::string, Cursor>> ports_;
};

std::string names_of(const std::map<std::string, DrivePort, std::less<>>& ports) {
    std::string names;
    for (const auto& [name, port] : ports) names += (names.empty() ? "" : ", ") + name;
    return names.empty() ? "nothing" : names;
}

// An error if the recording does not have all messages that the behaviour reads.
Expected<void> check_in_ports(const RecordedDrive& drive, const Component& behavior) {
    for (const auto& port : behavior.in_ports()) {
        const auto recorded = drive.arrived.find(port->name());
        if (recorded == drive.arrived.end()) {
            return failure(
                fmt::format("input '{0}' is not in the recording, which has {1} for {2}: name a topic with "
                            "--map TOPIC={2}.{0}",
                            port->name(), names_of(drive.arrived), behavior.name()));
        }
        if (recorded->second.type == port->type() || recorded->second.messages.empty()) continue;
        if (recorded->second.type->name == port->type()->name && !port->type()->is_compiled()) {
            return failure(fmt::format("input '{}': the definition of {} differs from the one in the recording",
                                       port->name(), port->type()->name));
        }
        return failure(fmt::format("input '{}' is a {}, and the recording has a {}", port->name(), port->type()->name,
                                   recorded->second.type->name));
    }
    return {};
}

SystemSpec system_of(const RecordedDrive& drive) {
    SystemSpec spec;
    spec.file = drive.entry.place.file;
    spec.rate = drive.rate;
    spec.physics_step = drive.physics_step;
    spec.seed = drive.seed;
    spec.entries.emplace_back(drive.entry);
    ComponentEntry player;
    player.name = player_of(drive.entry.name);
    player.type = RecordedDevice::type_name;
    spec.entries.emplace_back(std::move(player));
    return spec;
}

}  // namespace

Expected<const BehaviorEntry*> recorded_behavior(const SystemSpec& spec, const std::string& component) {
    if (const auto* entry = find_entry<BehaviorEntry>(spec, component); entry != nullptr) return entry;
    std::vector<std::string_view> names;
    for (const BehaviorEntry* each : entries_of<BehaviorEntry>(spec)) names.push_back(each->name);
    return failure(fmt::format("the recorded system has no behaviour '{}'{}; it has {}", shown(component),
                               did_you_mean(component, names),
                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

Expected<RecordedDrive> drive_of(Replay& replay, RunningSystem& live, const std::string& component) {
    const SystemSpec& spec = live.spec();
    const auto entry = recorded_behavior(spec, component);
    if (!entry) return Unexpected(entry.error());
    RecordedDrive drive{.entry = **entry,
                        .rate = spec.rate,
                        .physics_step = spec.physics_step,
                        .seed = live.options().build.seed_wins ? live.options().build.seed
                                                               : spec.seed.value_or(live.options().build.seed)};
    live.activate();
    ActKeeper keeper(drive, live);
    live.observe_acts(&keeper);
    const int start = live.generation();
    const auto keep = [&](std::map<std::string, DrivePort, std::less<>>& ports, const Port& port, bool is_new) {
        DrivePort& kept = ports[port.name()];
        kept.type = port.type();
        for (std::size_t i = 0; is_new && i < port.message_count(); ++i) {
            const MessageView message = port.message(i);
            kept.messages.emplace_back(drive.ticks, AnyMessage{Value(message.data), message.tm});
        }
    };
    for (;; ++drive.ticks) {
        const auto more = replay.before_tick(live);
        if (!more) return Unexpected(more.error());
        if (live.generation() != start) {
            drive.notes.push_back(
                fmt::format("the run was restarted or went back after {:g} s: only the part before that was judged",
                            static_cast<double>(drive.ticks) / drive.rate));
            break;
        }
        const Component* its = std::as_const(live).system().find(component);
        if (!*more || its == nullptr) break;
        for (const auto& port : its->in_ports()) port->follow();
        live.tick();
        for (const auto& port : std::as_const(*its).in_ports())
            keep(drive.arrived, *port, port->arrival_tick() == drive.ticks);
        for (const auto& port : std::as_const(*its).out_ports())
            keep(drive.published, *port, port->latched_tick() == drive.ticks);
    }
    live.observe_acts(nullptr);
    return drive;
}

namespace {

// A system of only the judged behaviour and the device that plays the recorded messages.
class JudgedSystem {
public:
    static Expected<JudgedSystem> make(const RecordedDrive& drive, const Project& project, LiveOptions options) {
        options.components[std::string(RecordedDevice::type_name)][std::string(simulated)] =
            [&drive](const ComponentEntry&, System& system) -> Expected<std::unique_ptr<Component>> {
            const Component* behavior = system.find(drive.entry.name);
            if (auto fits = check_in_ports(drive, *behavior); !fits) return Unexpected(fits.error());
            auto player = std::make_unique<RecordedDevice>(player_of(drive.entry.name));
            for (const auto& port : behavior->in_ports()) player->add(port->name(), drive.arrived.at(port->name()));
            return player;
        };
        auto seconds = std::make_unique<double>(0);
        if (!drive.times.empty()) {
            options.build.real_time = true;
            options.build.clock = [now = seconds.get()] { return *now; };
        }
        auto live = RunningSystem::make(system_of(drive), project, std::move(options));
        if (!live) return Unexpected(live.error());
        const std::string& name = drive.entry.name;
        // Connects the device to the inputs of the present version of the behaviour.
        for (const auto& port : std::as_const(**live).system().find(name)->in_ports()) {
            const Connect connect{.from = player_of(name) + "." + port->name(), .to = name + "." + port->name()};
            if (auto done = (*live)->act(connect, {}); !done) return Unexpected(done.error());
        }
        (*live)->activate();
        return JudgedSystem(drive, std::move(seconds), std::move(*live));
    }

    /// Performs the acts before the next tick.
    Expected<void> act() {
        if (ticks_ < drive_->times.size()) *seconds_ = drive_->times[ticks_];
        const std::int64_t now = std::as_const(*live_).system().now().tick;
        for (; next_ < drive_->acts.size() && drive_->acts[next_].first <= now; ++next_) {
            const Act& act = drive_->acts[next_].second;
            const auto done = live_->act(act, {});
            if (done) continue;
            return failure(fmt::format("{} at {:g} s of the recording fails now: {}", act_in_words(name_of(act)),
                                       std::as_const(*live_).system().now().seconds, done.error().message),
                           done.error().place);
        }
        return {};
    }
    void tick() {
        live_->tick();
        ++ticks_;
    }
    RunningSystem& live() { return *live_; }
    const Component& behavior() const { return *std::as_const(*live_).system().find(drive_->entry.name); }

private:
    JudgedSystem(const RecordedDrive& drive, std::unique_ptr<double> seconds, std::unique_ptr<RunningSystem> live)
        : drive_(&drive), seconds_(std::move(seconds)), live_(std::move(live)) {}

    const RecordedDrive* drive_;
    std::unique_ptr<double> seconds_;  // the time of the system's clock
    std::unique_ptr<RunningSystem> live_;
    std::size_t next_ = 0;   // index of the next act
    std::size_t ticks_ = 0;  // number of performed ticks
};

}  // namespace

Expected<Judgement> judge(const RecordedDrive& drive, const Project& project, const LiveOptions& options,
                          double tolerance, JudgedCurves* curves) {
    auto judged = JudgedSystem::make(drive, project, options);
    if (!judged) return Unexpected(judged.error());
    Judgement judgement{.ticks = drive.ticks, .notes = drive.notes};
    Judge each(drive, tolerance, judgement, curves);
    each.follow(judged->behavior());
    std::int64_t equal = 0;  // ticks before the first difference
    for (std::int64_t i = 0; i < drive.ticks; ++i) {
        if (auto done = judged->act(); !done) return Unexpected(done.error());
        judged->tick();
        each.compare(judged->behavior(), judged->live().system().last_tick());
        if (judgement.different == 0) ++equal;
    }
    if (judgement.different == 0) return judgement;
    // Repeats the run up to the first difference to get its lines: tracing every tick would take too long.
    auto again = JudgedSystem::make(drive, project, options);
    if (!again) return Unexpected(again.error());
    for (std::int64_t i = 0; i <= equal; ++i) {
        if (auto done = again->act(); !done) return Unexpected(done.error());
        if (i < equal) again->tick();
    }
    auto lines = lines_of_next_tick(again->live(), drive.entry.name);
    if (lines) judgement.lines = std::move(*lines);
    return judgement;
}

}  // namespace nezumi
