// The phases of a tick, and the components of the system.
#include "engine/system/system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "engine/base/list.hpp"
#include "engine/base/names.hpp"
#include "engine/base/schedule.hpp"
#include "engine/base/worker_pool.hpp"
#include "engine/system/network.hpp"
#include "engine/system/pacer.hpp"

namespace nezumi {
namespace {

// With fewer components, one thread is faster: sharing costs as much as some dozens of executions.
constexpr std::size_t worth_threads = 64;

// "name", or "host/name" on another host.
bool is_component_name(std::string_view name) {
    const std::size_t slash = name.find('/');
    if (slash == std::string_view::npos) return is_identifier(name);
    return is_identifier(name.substr(0, slash)) && is_identifier(name.substr(slash + 1));
}

// The index of the worker of this thread; 0 on the thread that ticks.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a thread's own number, not shared state
thread_local std::size_t current_worker = 0;

}  // namespace

double monotonic_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

System::System(const Settings& settings, LogSink log)
    : settings_(settings),
      steps_per_tick_(steps_per_tick(settings.rate, settings.physics_step).value()),
      log_(std::move(log)),
      started_at_(settings.real_time ? settings.clock() : 0),
      worker_logs_(static_cast<std::size_t>(std::max(1, settings.threads))) {
    if (settings.threads > 1) workers_ = std::make_unique<WorkerPool>(settings.threads);
}

System::~System() = default;

void System::log(LogLevel level, std::string text) const {
    if (log_) log_({level, now_.seconds, "", std::move(text)});
}

void System::take_world(std::unique_ptr<World> world) {
    world_ = std::move(world);
    if (world_ != nullptr) world_->use_threads(workers_.get());
}

void System::take_network(std::unique_ptr<Network> network) { network_ = std::move(network); }

Expected<Component*> System::add(std::unique_ptr<Component> component) {
    const std::string& name = component->name();
    if (!is_component_name(name)) {
        return failure(fmt::format("'{}' is not a valid name: expected letters, digits and _, not beginning with a "
                                   "digit, and no keyword of Lua",
                                   name),
                       component->place);
    }
    if (is_reserved_name(name))
        return failure(fmt::format("'{}' is a command of the console: choose another name", name), component->place);
    if (const Component* other = find(name)) {
        std::string first = other->place.line > 0 ? fmt::format(", first in line {}", other->place.line) : "";
        return failure(fmt::format("the name '{}' is given twice{}", name, first), component->place);
    }
    if (!std::isfinite(component->rate) || component->rate < 0) {
        return failure(
            fmt::format("{}: expected a rate above 0 Hz, or 0 for the tick's, got {}", name, component->rate),
            component->place);
    }
    if (component->rate > 0 && component->rate < slowest_rate)
        return failure(
            fmt::format("{}: expected a rate of at least {} Hz, got {}", name, slowest_rate, component->rate),
            component->place);
    if (component->rate > settings_.rate) {
        return failure(
            fmt::format("{}: a rate of {} Hz is above the tick's {} Hz", name, component->rate, settings_.rate),
            component->place);
    }
    component->set_log([this](LogLine line) {
        line.seconds = now_.seconds;
        if (workers_ != nullptr) {
            worker_logs_[current_worker].push_back(std::move(line));
        } else if (log_) {
            log_(line);
        }
    });
    component->set_tick_rate(settings_.rate);
    Component* added = component.get();
    if (auto* robot = dynamic_cast<Robot*>(added)) {
        robot->set_at_rest(at_rest_);
        robots_.push_back(robot);
        if (stopped_) robot->emergency_stop();
    }
    for (const auto& port : added->out_ports()) {
        if (port->rate() == 0) port->set_rate(added->rate);
    }
    grouped_ = false;
    change_layout();
    by_name_.emplace(added->name(), added);
    components_.push_back(std::move(component));
    return added;
}

std::uint64_t System::new_layout() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

Expected<void> System::remove(std::string_view name) {
    const auto found = component(name);
    if (!found) return Unexpected(found.error());
    Component* gone = *found;
    if (gone->state() == LifeState::active) {
        if (auto ok = gone->deactivate(now_); !ok) log(LogLevel::warn, describe(ok.error()));
    }
    gone->latch_outputs(now_);
    wiring_.disconnect_all(*gone, now_);
    by_name_.erase(gone->name());
    // Holds of removed ports end, so a later component with the same name starts without them.
    const std::string ports = gone->name() + ".";
    std::erase_if(holders_, [&](const auto& held) { return held.first.starts_with(ports); });
    std::erase_if(foreign_, [&](const ConnectionSpec& each) {
        return each.from.starts_with(ports) || each.to.starts_with(ports);
    });
    grouped_ = false;
    change_layout();
    std::erase_if(robots_, [&](const Robot* robot) { return robot == gone; });
    for (Robot* robot : robots_) robot->forget(*gone);
    std::erase_if(components_, [&](const auto& component) { return component.get() == gone; });
    return {};
}

Component* System::find_component(std::string_view name) const {
    const auto found = by_name_.find(name);
    return found != by_name_.end() ? found->second : nullptr;
}

std::vector<ConnectionSpec> System::connections() const {
    std::vector<ConnectionSpec> all;
    for (const Connection& each : wiring_.connections())
        all.push_back({path(*each.from_component, *each.from), path(*each.to_component, *each.to), {}});
    return all;
}

const Robot* System::find_robot(std::string_view name) const {
    for (Robot* robot : robots_) {
        if (robot->name() == name) return robot;
    }
    return nullptr;
}

Expected<Component*> System::component_named(std::string_view name) const {
    if (Component* found = find_component(name)) return found;
    const auto name_of = [](const auto& component) -> std::string_view { return component->name(); };
    return failure(fmt::format("there is no component '{}'{}", shown(name), did_you_mean(name, components_, name_of)));
}

Expected<std::pair<Component*, std::string>> System::split(std::string_view port_path) const {
    const auto dot = port_path.find('.');
    if (dot == std::string_view::npos || dot == 0 || dot + 1 == port_path.size()) {
        return failure(fmt::format("'{}' is not a port: expected \"name.port\"", shown(port_path)));
    }
    const auto owner = component_named(port_path.substr(0, dot));
    if (!owner) return failure(fmt::format("'{}': {}", shown(port_path), owner.error().message));
    return std::pair{*owner, std::string(port_path.substr(dot + 1))};
}

Expected<Port*> System::port_named(std::string_view port_path) const {
    const auto parts = split(port_path);
    if (!parts) return Unexpected(parts.error());
    const auto& [owner, name] = *parts;
    if (Port* found = owner->find_port(name)) return found;
    auto names = port_names(*owner, Direction::in);
    for (const std::string_view out : port_names(*owner, Direction::out)) names.push_back(out);
    return failure(fmt::format("{} has no port '{}'{}", owner->name(), shown(name), did_you_mean(name, names)));
}

// Makes the network create the other host's end of a connection.
Expected<void> System::reach(std::string_view from, std::string_view to) {
    if (is_remote(from) == is_remote(to)) return {};
    const std::string_view remote = is_remote(from) ? from : to;
    if (port(remote)) return {};
    const auto other = port(is_remote(from) ? to : from);
    if (!other) return Unexpected(other.error());
    if (network_ != nullptr) return network_->reach(remote, **other);
    return failure(
        fmt::format("{} is on another host: add network {{ name = ... }} to the system file", shown(remote)));
}

Expected<Connection> System::wire(std::string_view from, std::string_view to, std::optional<std::uint64_t> number) {
    if (auto reached = reach(from, to); !reached) return Unexpected(reached.error());
    const auto source = split(from);
    if (!source) return Unexpected(source.error());
    const auto sink = split(to);
    if (!sink) return Unexpected(sink.error());
    grouped_ = false;
    return wiring_.connect(*source->first, source->second, *sink->first, sink->second, number);
}

std::vector<std::string> System::peers(const Component& component, const Port& port) const {
    std::vector<std::string> all = peers(port);
    const std::string end = path(component, port);
    for (const ConnectionSpec& each : foreign_) {
        if (each.from == end) all.push_back(each.to);
        if (each.to == end) all.push_back(each.from);
    }
    return all;
}

Expected<void> System::connect_foreign(ConnectionSpec wanted) {
    if (!foreign_check_)
        return failure(
            fmt::format("{} to {}: this program can't connect to ports of other programs", wanted.from, wanted.to));
    if (auto ok = foreign_check_(*this, wanted); !ok) return ok;
    if (contains(foreign_, wanted))
        return failure(fmt::format("{} is connected to {} already", wanted.from, wanted.to));
    foreign_.push_back(std::move(wanted));
    return {};
}

bool System::disconnect_foreign(std::string_view end) {
    return std::erase_if(foreign_, [&](const ConnectionSpec& each) { return each.from == end || each.to == end; }) > 0;
}

Expected<void> System::connect(std::string_view from, std::string_view to) {
    if (is_foreign(from) || is_foreign(to)) return connect_foreign({std::string(from), std::string(to), {}});
    const auto made = wire(from, to, std::nullopt);
    if (!made) return Unexpected(made.error());
    if (made->to->sources().size() == 2 && dynamic_cast<Device*>(made->to_component) != nullptr) {
        log(LogLevel::warn,
            fmt::format(
                "{} has several connections: the last one in the order of the connect lines wins (reported once)", to));
    }
    return {};
}

Expected<void> System::connect_again(const Dropped& dropped) {
    const auto made = wire(dropped.from, dropped.to, dropped.number);
    return made ? Expected<void>() : Unexpected(made.error());
}

Expected<void> System::disconnect(std::string_view from, std::string_view to) {
    if (is_foreign(from) || is_foreign(to)) {
        if (std::erase(foreign_, ConnectionSpec{std::string(from), std::string(to), {}}) > 0) return {};
        return failure(fmt::format("{} is not connected to {}", shown(from), shown(to)));
    }
    const auto source = port(from);
    if (!source) return Unexpected(source.error());
    const auto sink = port(to);
    if (!sink) return Unexpected(sink.error());
    if (!wiring_.disconnect(**source, **sink))
        return failure(fmt::format("{} is not connected to {}", shown(from), shown(to)));
    grouped_ = false;
    return {};
}

std::vector<System::Dropped> System::disconnect_all(const Port& port) {
    std::vector<Dropped> all;
    for (const Connection& each : wiring_.connections()) {
        if (each.from == &port || each.to == &port)
            all.push_back({path(*each.from_component, *each.from), path(*each.to_component, *each.to), each.number});
    }
    wiring_.disconnect_all(port, now_);
    grouped_ = false;
    return all;
}

const Actor* System::holder(std::string_view port_path) const {
    const auto found = holders_.find(port_path);
    if (found == holders_.end()) return nullptr;
    const auto port = port_named(port_path);
    return port && (*port)->override() != Override::none ? &found->second : nullptr;
}

std::vector<std::string> System::held_by(const Actor& who) const {
    std::vector<std::string> held;
    for (const auto& [port_path, owner] : holders_) {
        if (owner == who && holder(port_path) != nullptr) held.push_back(port_path);
    }
    return held;
}

void System::emergency_stop() {
    stopped_ = true;
    for (Robot* robot : robots_) robot->emergency_stop();
}

Expected<void> System::rearm() {
    if (!stopped_) return failure("there is no emergency stop: rearm() works only after stop()");
    for (const Robot* robot : robots_) {
        if (robot->is_twin() || robot->stands()) continue;
        return failure(fmt::format("{} still moves, at {:.3f} m/s and {:.3f} rad/s: rearm() needs standstill",
                                   robot->name(), robot->measured().vx, robot->measured().va));
    }
    stopped_ = false;
    for (Robot* robot : robots_) robot->rearm();
    return {};
}

bool System::is_due(const Component& component) const {
    return nezumi::is_due(now_.tick, component.rate, settings_.rate, now_.left_out);
}

template <class Action>
void System::share_out(std::size_t count, const Action& action) {
    workers_->run(count, [&](std::size_t begin, std::size_t end, std::size_t worker) {
        current_worker = worker;
        for (std::size_t i = begin; i < end; ++i) action(i);
        current_worker = 0;
    });
    flush_logs();
}

void System::flush_logs() {
    // Shares are in order, and each worker's lines are in order, so the result has the order of one thread.
    for (std::vector<LogLine>& lines : worker_logs_) {
        if (log_) {
            for (const LogLine& line : lines) log_(line);
        }
        lines.clear();
    }
}

void System::end_when_out_of_time() {
    // Checks all components, not only those that are due: a hook may have run between two ticks.
    const auto found = std::find_if(components_.begin(), components_.end(),
                                    [](const auto& component) { return component->out_of_time().has_value(); });
    if (found != components_.end()) fatal_error_ = (*found)->out_of_time();
}

namespace {

// Calls `work`. If the component is measured, notes the elapsed time, not the CPU time: the tick also waits for the bus
// of a device, and for the thread of a detector.
template <class Work>
void measured(const Component& component, std::int64_t tick, const Work& work) {
    using Clock = std::chrono::steady_clock;
    TickCosts* const costs = component.tick_costs();
    if (costs == nullptr) return work();
    const auto began = Clock::now();
    work();
    costs->add(tick, std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - began).count());
}

}  // namespace

template <class ForEach>
void System::run_phases(const Group& group, const ForEach& for_each) {
    for_each(group.devices, [this](Device& device) {
        measured(device, now_.tick, [&] {
            device.sense(now_);
            device.latch_outputs(now_);
        });
    });
    // Outputs latch after all executions, so no execution sees another's outputs of this tick. So each component can
    // latch its inputs and execute at once.
    std::atomic<bool> has_hung = false;
    for_each(group.behaviors, [this, &has_hung](Component& behavior) {
        const LifeState before = behavior.state();
        measured(behavior, now_.tick, [&] {
            behavior.latch_inputs(now_);
            if (is_due(behavior) && !at_rest_) behavior.execute(now_);
        });
        if (behavior.out_of_time()) out_of_time_ = true;
        if (behavior.state() != before && behavior.last_error().kind == Error::Kind::out_of_time) has_hung = true;
    });
    for_each(group.behaviors, [this](Component& behavior) { behavior.latch_outputs(now_); });
    for_each(group.devices, [this, &has_hung](Device& device) {
        auto* robot = has_hung ? dynamic_cast<Robot*>(&device) : nullptr;
        if (robot != nullptr) robot->halt();
        measured(device, now_.tick, [&] {
            device.latch_inputs(now_);
            device.actuate(now_);
        });
    });
}

void System::run_groups() {
    const auto one_by_one = [](const auto& all, const auto& action) {
        for (auto* one : all) action(*one);
    };
    if (workers_ == nullptr || components_.size() < worth_threads) {
        for (const Group& group : groups_) run_phases(group, one_by_one);
        return flush_logs();
    }
    // A large group is divided within each phase, small ones are not.
    const auto shared = [this](const auto& all, const auto& action) {
        share_out(all.size(), [&](std::size_t i) { action(*all[i]); });
    };
    std::size_t large = 0;
    for (; large < groups_.size() && groups_[large].size() >= worth_threads; ++large)
        run_phases(groups_[large], shared);
    share_out(groups_.size() - large, [&](std::size_t i) { run_phases(groups_[large + i], one_by_one); });
}

double System::seconds_at(std::int64_t tick) const {
    return settings_.real_time ? settings_.clock() - started_at_ : static_cast<double>(tick) / settings_.rate;
}

void System::set_at_rest(bool at_rest) {
    at_rest_ = at_rest;
    for (Robot* robot : robots_) robot->set_at_rest(at_rest);
}

void System::step(World* world) {
    if (world == nullptr) return;
    world->step(steps_per_tick_);
    if (const Error* why = world->breakdown(); why != nullptr && !fatal_error_) fatal_error_ = *why;
}

// The ticks that the pacer skips after a stall count as passed.
void System::pass_left_out_ticks() {
    const std::int64_t due = std::llround(now_.seconds * settings_.rate);
    now_.left_out = due - now_.tick > Pacer::longest_burst ? due - now_.tick : 0;
    now_.tick += now_.left_out;
}

void System::tick() {
    now_.seconds = seconds_at(now_.tick);
    if (settings_.real_time) pass_left_out_ticks();
    if (!grouped_) {
        groups_ = group_components(components_, wiring_.connections(), worth_threads);
        grouped_ = true;
    }
    out_of_time_ = false;
    run_groups();
    if (out_of_time_ && settings_.out_of_time_is_fatal && !fatal_error_) end_when_out_of_time();
    for (PortObserver* observer : observers_) observer->latched(*this);
    step(world_.get());
    if (rig_) step(rig_->world.get());
    last_tick_ = now_;
    ++now_.tick;
    now_.seconds = seconds_at(now_.tick);
}

void System::stop(int brake_ticks) {
    for (auto component = components_.rbegin(); component != components_.rend(); ++component) {
        if ((*component)->state() != LifeState::active) continue;
        if (auto ok = (*component)->deactivate(now_); !ok) log(LogLevel::warn, describe(ok.error()));
    }
    for (int i = 0; i < brake_ticks; ++i) tick();
}

}  // namespace nezumi
