// The phases of a tick, and wiring with errors that name the nearest.
#include "engine/system/system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "engine/base/names.hpp"
#include "engine/base/schedule.hpp"
#include "engine/system/worker_pool.hpp"

namespace nezumi {
namespace {

// Fewer components than this are quicker on one thread: waking the others costs as much as some hundred executions.
constexpr std::size_t worth_threads = 256;

// The worker that runs this thread's share; 0 on the thread that ticks.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a thread's own number, not shared state
thread_local std::size_t current_worker = 0;

std::vector<std::string_view> port_names(const Component& component, Direction direction) {
    std::vector<std::string_view> names;
    if (direction == Direction::in) {
        for (const auto& port : component.in_ports()) names.push_back(port->name());
    } else {
        for (const auto& port : component.out_ports()) names.push_back(port->name());
    }
    return names;
}

std::string path(const Component& component, const Port& port) { return component.name() + "." + port.name(); }

// Why a connection to a port that is not there can't be, with the nearest name or else all that there are.
std::string no_port(const Component& component, Direction direction, std::string_view name) {
    const std::string_view kind = direction == Direction::in ? "in-port" : "out-port";
    const auto names = port_names(component, direction);
    std::string hint = did_you_mean(name, names);
    if (hint.empty() && !names.empty()) hint = fmt::format("; it has {}", fmt::join(names, ", "));
    return fmt::format("{} has no {} '{}'{}", component.name(), kind, name, hint);
}

// The first port at either end that would make the types equal, as the end of a sentence.
std::string fitting_port(const Component& from, const Port& out, const Component& to, const Port& in) {
    for (const auto& port : to.in_ports()) {
        if (port.get() != &in && port->type() == out.type())
            return fmt::format(" (did you mean '{}'?)", path(to, *port));
    }
    for (const auto& port : from.out_ports()) {
        if (port.get() != &out && port->type() == in.type())
            return fmt::format(" (did you mean '{}'?)", path(from, *port));
    }
    return "";
}

std::string wrong_direction(const Component& from, const Port& first, const Component& to, const Port& second) {
    const auto told = [](const Component& component, const Port& port) {
        return fmt::format("{} ({}) is an {}", path(component, port), port.type_name(),
                           port.direction() == Direction::in ? "in-port" : "out-port");
    };
    std::string hint = fitting_port(from, first, to, second);
    if (first.direction() == Direction::in && second.direction() == Direction::out)
        hint = fmt::format(" (did you mean connect(\"{}\", \"{}\")?)", path(to, second), path(from, first));
    return fmt::format("connect goes from an out-port to an in-port: {}, {}{}", told(from, first), told(to, second),
                       hint);
}

}  // namespace

System::System(const Settings& settings, LogSink log)
    : settings_(settings),
      steps_per_tick_(steps_per_tick(settings.rate, settings.physics_step).value()),
      log_(std::move(log)),
      worker_logs_(static_cast<std::size_t>(std::max(1, settings.threads))) {
    if (settings.threads > 1) workers_ = std::make_unique<WorkerPool>(settings.threads);
}

System::~System() = default;

void System::log(LogLevel level, std::string text) const {
    if (log_) log_({level, now_.seconds, "", std::move(text)});
}

Expected<Component*> System::add(std::unique_ptr<Component> component) {
    const std::string& name = component->name();
    if (!is_identifier(name)) {
        return failure(
            fmt::format("'{}' is no name: letters, digits and _, not beginning with a digit, and no keyword of Lua",
                        name),
            component->place);
    }
    if (is_reserved_name(name))
        return failure(fmt::format("'{}' is a word of the console: choose another name", name), component->place);
    if (const Component* other = find(name)) {
        std::string first = other->place.line > 0 ? fmt::format(", first in line {}", other->place.line) : "";
        return failure(fmt::format("the name '{}' is given twice{}", name, first), component->place);
    }
    if (!std::isfinite(component->rate) || component->rate < 0) {
        return failure(fmt::format("{}: a rate of {} Hz is not a positive number", name, component->rate),
                       component->place);
    }
    if (component->rate > settings_.rate) {
        return failure(
            fmt::format("{}: a rate of {} Hz is above the tick's {} Hz", name, component->rate, settings_.rate),
            component->place);
    }
    component->set_log([this](const LogLine& line) {
        if (workers_ != nullptr) {
            worker_logs_[current_worker].push_back(line);
        } else if (log_) {
            log_(line);
        }
    });
    component->set_tick_rate(settings_.rate);
    Component* added = component.get();
    if (auto* robot = dynamic_cast<Robot*>(added)) robots_.push_back(robot);
    grouped_ = false;
    by_name_.emplace(added->name(), added);
    components_.push_back(std::move(component));
    return added;
}

Expected<void> System::remove(std::string_view name) {
    const auto found = component(name);
    if (!found) return Unexpected(found.error());
    Component* gone = *found;
    if (gone->state() == LifeState::active) {
        if (auto ok = gone->deactivate(now_); !ok) log(LogLevel::warn, describe(ok.error()));
    }
    gone->latch_outputs(now_);
    for (const Connection& connection : connections_) {
        if (connection.from_component == gone) connection.to->latch(now_);
        if (connection.from_component == gone || connection.to_component == gone)
            connection.to->disconnect(*connection.from);
    }
    std::erase_if(connections_,
                  [&](const Connection& c) { return c.from_component == gone || c.to_component == gone; });
    by_name_.erase(gone->name());
    grouped_ = false;
    std::erase_if(robots_, [&](const Robot* robot) {
        if (robot == gone && robot->has_body()) ++removed_robots_;
        return robot == gone;
    });
    std::erase_if(components_, [&](const auto& component) { return component.get() == gone; });
    return {};
}

Component* System::find(std::string_view name) const {
    const auto found = by_name_.find(name);
    return found != by_name_.end() ? found->second : nullptr;
}

Robot* System::find_robot(std::string_view name) const {
    for (Robot* robot : robots_) {
        if (robot->name() == name) return robot;
    }
    return nullptr;
}

Expected<Component*> System::component(std::string_view name) const {
    if (Component* found = find(name)) return found;
    std::vector<std::string_view> names;
    for (const auto& component : components_) names.push_back(component->name());
    return failure(fmt::format("there is no component '{}'{}", name, did_you_mean(name, names)));
}

Expected<std::pair<Component*, std::string>> System::split(std::string_view port_path) const {
    const auto dot = port_path.find('.');
    if (dot == std::string_view::npos || dot == 0 || dot + 1 == port_path.size()) {
        return failure(fmt::format("'{}' names no port: expected \"name.port\"", port_path));
    }
    const auto owner = component(port_path.substr(0, dot));
    if (!owner) return failure(fmt::format("'{}': {}", port_path, owner.error().message));
    return std::pair{*owner, std::string(port_path.substr(dot + 1))};
}

Expected<Port*> System::port(std::string_view port_path) const {
    const auto parts = split(port_path);
    if (!parts) return Unexpected(parts.error());
    const auto& [owner, name] = *parts;
    if (Port* found = owner->find_port(name)) return found;
    auto names = port_names(*owner, Direction::in);
    for (const std::string_view out : port_names(*owner, Direction::out)) names.push_back(out);
    return failure(fmt::format("{} has no port '{}'{}", owner->name(), name, did_you_mean(name, names)));
}

Expected<void> System::connect(std::string_view from, std::string_view to) {
    const auto source = split(from);
    if (!source) return Unexpected(source.error());
    const auto sink = split(to);
    if (!sink) return Unexpected(sink.error());
    const auto& [from_component, from_name] = *source;
    const auto& [to_component, to_name] = *sink;

    OutPortBase* out = from_component->find_out_port(from_name);
    InPortBase* in = to_component->find_in_port(to_name);
    const Port* first = from_component->find_port(from_name);
    const Port* second = to_component->find_port(to_name);
    if (first == nullptr) return failure(no_port(*from_component, Direction::out, from_name));
    if (second == nullptr) return failure(no_port(*to_component, Direction::in, to_name));
    if (out == nullptr || in == nullptr)
        return failure(wrong_direction(*from_component, *first, *to_component, *second));
    if (out->type() != in->type()) {
        return failure(fmt::format("types differ: {} is {}, {} is {}{}", from, out->type_name(), to, in->type_name(),
                                   fitting_port(*from_component, *out, *to_component, *in)));
    }
    const std::vector<const OutPortBase*> sources = in->sources();
    if (std::find(sources.begin(), sources.end(), out) != sources.end())
        return failure(fmt::format("{} is connected to {} already", from, to));
    if (sources.size() == 1 && dynamic_cast<Device*>(to_component) != nullptr) {
        log(LogLevel::warn,
            fmt::format(
                "{} is fed by several connections: the last one in the order of the connect lines wins (said once)",
                to));
    }
    in->connect(*out);
    connections_.push_back({from_component, out, to_component, in});
    grouped_ = false;
    return {};
}

Expected<void> System::disconnect(std::string_view from, std::string_view to) {
    const auto source = port(from);
    if (!source) return Unexpected(source.error());
    const auto sink = port(to);
    if (!sink) return Unexpected(sink.error());
    const auto found = std::find_if(connections_.begin(), connections_.end(),
                                    [&](const Connection& c) { return c.from == *source && c.to == *sink; });
    if (found == connections_.end()) return failure(fmt::format("{} is not connected to {}", from, to));
    found->to->disconnect(*found->from);
    connections_.erase(found);
    grouped_ = false;
    return {};
}

std::vector<std::string> System::peers(const Port& port) const {
    std::vector<std::string> all;
    for (const Connection& connection : connections_) {
        if (connection.from == &port) all.push_back(path(*connection.to_component, *connection.to));
        if (connection.to == &port) all.push_back(path(*connection.from_component, *connection.from));
    }
    return all;
}

std::vector<std::string> System::disconnect_all(const Port& port) {
    std::vector<std::string> all = peers(port);
    for (const Connection& connection : connections_) {
        if (connection.from == &port) connection.to->latch(now_);  // what was published still arrives
        if (connection.from == &port || connection.to == &port) connection.to->disconnect(*connection.from);
    }
    std::erase_if(connections_, [&](const Connection& c) { return c.from == &port || c.to == &port; });
    grouped_ = false;
    return all;
}

bool System::is_due(const Component& component) const {
    return nezumi::is_due(now_.tick, component.rate, settings_.rate);
}

void System::group_components() {
    // Each component names one before it in its group, or itself: the first.
    std::vector<std::size_t> earlier(components_.size());
    std::iota(earlier.begin(), earlier.end(), std::size_t{0});
    const auto first_of = [&](std::size_t i) {
        while (earlier[i] != i) i = earlier[i] = earlier[earlier[i]];
        return i;
    };
    std::unordered_map<const Component*, std::size_t> index;
    for (std::size_t i = 0; i < components_.size(); ++i) index.emplace(components_[i].get(), i);
    for (const Connection& connection : connections_) {
        const std::size_t from = first_of(index.at(connection.from_component));
        const std::size_t to = first_of(index.at(connection.to_component));
        earlier[std::max(from, to)] = std::min(from, to);
    }

    groups_.clear();
    std::vector<std::size_t> group(components_.size());
    for (std::size_t i = 0; i < components_.size(); ++i) {
        const std::size_t first = first_of(i);
        if (first == i) {
            group[i] = groups_.size();
            groups_.emplace_back();
        }
        Group& its = groups_[group[first]];
        if (auto* device = dynamic_cast<Device*>(components_[i].get())) {
            its.devices.push_back(device);
        } else {
            its.behaviors.push_back(components_[i].get());
        }
    }
    std::stable_partition(groups_.begin(), groups_.end(), [](const Group& g) { return g.size() >= worth_threads; });
    grouped_ = true;
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
    // Shares are in order and each worker's lines are in order: together they are in the order of one thread.
    for (std::vector<LogLine>& lines : worker_logs_) {
        if (log_) {
            for (const LogLine& line : lines) log_(line);
        }
        lines.clear();
    }
}

void System::notify_observers() {
    for (const auto& component : components_) {
        for (const auto& port : component->out_ports()) {
            if (port->latched_tick() != now_.tick) continue;
            for (PortObserver* observer : observers_) observer->latched(*component, *port, now_);
        }
    }
}

void System::end_when_out_of_time() {
    // Not only those that are due: a hook that ran between two ticks counts too.
    const auto found = std::find_if(components_.begin(), components_.end(),
                                    [](const auto& component) { return component->out_of_time().has_value(); });
    if (found != components_.end()) fatal_error_ = (*found)->out_of_time();
}

template <class ForEach>
void System::run_phases(const Group& group, const ForEach& for_each) {
    for_each(group.devices, [this](Device& device) {
        device.sense(now_);
        device.latch_outputs(now_);
    });
    // No execution sees what another one writes, as outputs latch when all have ended: each may follow its own inputs
    // at once.
    for_each(group.behaviors, [this](Component& behavior) {
        behavior.latch_inputs(now_);
        if (is_due(behavior)) behavior.execute(now_);
        if (behavior.out_of_time()) out_of_time_ = true;
    });
    for_each(group.behaviors, [this](Component& behavior) { behavior.latch_outputs(now_); });
    for_each(group.devices, [this](Device& device) {
        device.latch_inputs(now_);
        device.actuate(now_);
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
    // A large group is shared out within each phase, the small ones as a whole.
    const auto shared = [this](const auto& all, const auto& action) {
        share_out(all.size(), [&](std::size_t i) { action(*all[i]); });
    };
    std::size_t large = 0;
    for (; large < groups_.size() && groups_[large].size() >= worth_threads; ++large)
        run_phases(groups_[large], shared);
    share_out(groups_.size() - large, [&](std::size_t i) { run_phases(groups_[large + i], one_by_one); });
}

void System::tick() {
    if (!grouped_) group_components();
    out_of_time_ = false;
    run_groups();
    if (out_of_time_ && settings_.out_of_time_is_fatal && !fatal_error_) end_when_out_of_time();
    if (!observers_.empty()) notify_observers();
    if (world_ != nullptr) {
        world_->step(steps_per_tick_);
        if (const Error* why = world_->breakdown(); why != nullptr && !fatal_error_) fatal_error_ = *why;
    }
    ++now_.tick;
    now_.seconds = static_cast<double>(now_.tick) / settings_.rate;
}

void System::stop(int brake_ticks) {
    for (auto component = components_.rbegin(); component != components_.rend(); ++component) {
        if ((*component)->state() != LifeState::active) continue;
        if (auto ok = (*component)->deactivate(now_); !ok) log(LogLevel::warn, describe(ok.error()));
    }
    for (int i = 0; i < brake_ticks; ++i) tick();
}

}  // namespace nezumi
