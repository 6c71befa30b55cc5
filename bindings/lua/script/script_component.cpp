// Connects the life cycle to a script, and replaces the script by another version.
#include "bindings/lua/script/script_component.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "bindings/lua/sandbox/watchdog.hpp"
#include "bindings/lua/script/carry_over.hpp"
#include "bindings/lua/script/line_texts.hpp"
#include "bindings/lua/script/script_config.hpp"
#include "bindings/lua/script/script_globals.hpp"

namespace nezumi {
namespace {

template <class Ports>
auto find_fitting(Ports& ports, const PortDeclaration& declaration) {
    return std::find_if(ports.begin(), ports.end(),
                        [&](const auto& port) { return port != nullptr && declaration.fits(*port); });
}

// Removes the port that fits the declaration from `ports` and returns it; null if there is none.
template <class Ports>
auto take_fitting(Ports& ports, const PortDeclaration& declaration) {
    typename Ports::value_type taken;
    if (const auto found = find_fitting(ports, declaration); found != ports.end()) {
        taken = std::move(*found);
        ports.erase(found);
    }
    return taken;
}

}  // namespace

Expected<std::unique_ptr<ScriptComponent>> ScriptComponent::load(std::string name, const SourceText& source,
                                                                 ScriptContext context) {
    context.component = name;
    context.version = 1;
    const std::string type = type_of_file(source.path.empty() ? source.shown : source.path);
    auto script = Script::load(source, std::move(context));
    if (!script) return Unexpected(script.error());
    auto component = std::unique_ptr<ScriptComponent>(new ScriptComponent(std::move(name), type));
    Version first;
    first.script = std::move(*script);
    first.number = 1;
    first.parameters = first.script->take_parameters();
    component->make_ports(first);
    component->fill_slots(first);
    first.script->bind(*component);
    component->replace(std::move(first));
    return component;
}

Expected<PlainData> ScriptComponent::call_command(std::string_view command, const PlainData& arguments,
                                                  const Time& now) {
    set_now(now);
    std::vector<std::size_t> written;
    for (const auto& port : out_ports_) written.push_back(port->pending());
    auto results = run(Hook::command, [&] { return script_->call_command(command, arguments); });
    if (!results) {
        for (std::size_t i = 0; i < written.size(); ++i) out_ports_[i]->discard_after(written[i]);
    }
    return results;
}

Expected<PlainData> ScriptComponent::copy_state() const {
    std::vector<Dropped> dropped;
    return script_->take_state(dropped);
}

// A call that ran out of time has delayed the tick already, so only a limited part of the state is copied.
Component::LeftState ScriptComponent::left_state() {
    std::vector<Dropped> dropped;
    auto look = script_->state_snapshot({}, &dropped);
    if (!look) return {.lost = "state: " + look.error().message};
    if (look->whole < look->data.tables.size())
        return {.lost = fmt::format("state has more than {} values or {} kB of text", PlainLimit{}.values,
                                    PlainLimit{}.text >> 10)};
    LeftState left{.data = std::move(look->data)};
    if (!dropped.empty()) left.lost = fmt::format("{} is {}", dropped.front().path, dropped.front().what);
    return left;
}

void ScriptComponent::restore(const PlainData& left) {
    if (auto ok = script_->set_state(left); !ok)
        log(LogLevel::warn, "state could not be restored: " + describe(ok.error()));
}

ComponentAbout ScriptComponent::about() const {
    const ScriptAbout& about = script_->about();
    return {
        .description = script_->doc(), .version = about.version, .vendor = about.vendor, .category = about.category};
}

bool ScriptComponent::visit_member(std::string_view member, const LeafVisitor& visit) const {
    if (member == "tasks") visit_plain(describe(tasks()), visit);
    if (member == "probes") visit_plain(values_of(probes()), visit);
    if (member != "state") return member == "tasks" || member == "probes";
    if (const auto state = state_snapshot({})) visit_plain(state->data, visit);
    return true;
}

ScriptComponent::Loading ScriptComponent::next_loading() const {
    Loading next{.context = script_->context(), .parameters = parameters_};
    next.context.version = next_version();
    next.context.tick_rate = tick_rate();
    next.parameters.take_staged();
    return next;
}

Expected<std::unique_ptr<Script>> ScriptComponent::load_beside(const Loading& loading,
                                                               std::vector<ScriptFile>& required) {
    bool looks_at_tick = false;
    auto script =
        Script::load(loading.source, loading.context,
                     {.parameters = &loading.parameters, .required = &required, .looks_at_tick = &looks_at_tick});
    if (looks_at_tick && (script || script.error().kind != Error::Kind::out_of_time)) return nullptr;
    return script;
}

Expected<ScriptComponent::Version> ScriptComponent::prepare(const Loading& loading, std::unique_ptr<Script> loaded,
                                                            const Time& now, std::vector<ScriptFile>& required) {
    Version next;
    std::vector<Dropped> dropped;
    auto state = script_->take_state(dropped);
    if (!state)
        return failure(
            fmt::format(
                "the new version can't take over the state, so the old version continues: {}. Keep less in state, or "
                "restart() the system",
                state.error().message),
            state.error().place);
    describe_dropped(dropped, next.warnings);

    ScriptContext context = loading.context;
    context.seconds = now.seconds;
    Parameters running = parameters_;
    running.take_staged();
    Parameters settings = running;
    const std::size_t others = required.size();
    const auto load = [&] {
        required.erase(required.begin() + static_cast<std::ptrdiff_t>(others), required.end());
        return Script::load(loading.source, context,
                            {.parameters = &settings, .state = &*state, .required = &required});
    };
    if (loaded == nullptr || !same_values(loading.parameters, running)) {
        auto script = load();
        if (!script) return Unexpected(script.error());
        loaded = std::move(*script);
    } else if (auto ok = loaded->take_state_over(*state); !ok) {
        return Unexpected(ok.error());
    }
    if (auto fits = check_set(*this, loaded->parameters()); !fits) {
        next.warnings.push_back(fmt::format("set '{}' is no longer valid, and no set is in use now: {}",
                                            shown(set_in_use()), fits.error().message));
        leave_set(*this, settings);
        auto script = load();  // again, because the top level may have read a value of that parameter set
        if (!script) return Unexpected(script.error());
        loaded = std::move(*script);
    }
    next.script = std::move(loaded);
    next.number = next_version();
    describe_lost(running, settings, next.script->parameters(), next.warnings);
    return next;
}

Expected<void> ScriptComponent::adopt(Version& next, const Time& now) {
    set_now(now);
    make_ports(next);
    fill_slots(next);
    next.script->bind(*this);
    if (state() == LifeState::active) next.script->tasks().start_all(now.seconds);
    auto ok = run(Hook::on_reload, [&] { return next.script->call_on_reload(version_); });
    if (!ok) return ok;
    next.parameters = next.script->take_parameters();  // with the changes of on_reload
    next.parameters.begin_version();
    return ok;
}

std::vector<Port*> ScriptComponent::ports_going(const Version& other) const {
    const auto goes = [&](const Port& port) {
        return std::none_of(other.script->ports().begin(), other.script->ports().end(),
                            [&](const PortDeclaration& declaration) { return declaration.fits(port); });
    };
    std::vector<Port*> going;
    for (const auto& port : in_ports_) {
        if (goes(*port)) going.push_back(port.get());
    }
    for (const auto& port : out_ports_) {
        if (goes(*port)) going.push_back(port.get());
    }
    return going;
}

void ScriptComponent::commit(Version next, int reload) {
    constexpr std::size_t most = 8;
    constexpr std::size_t most_memory = std::size_t{32} << 20;  // [bytes]

    const bool set_fits = check_set(*this, next.parameters).has_value();
    Version old = replace(std::move(next));
    old.replaced_by = reload;
    old.set = set_in_use();
    old.uses = uses();
    if (!set_fits) note_set_in_use("");  // its values were removed when this version was prepared
    if (state() == LifeState::active && !script_->tasks().empty())
        log(LogLevel::info, fmt::format("tasks start again: {}", script_->tasks().names()));
    if (const std::string kept = kept_text(old.parameters, parameters_, configured); !kept.empty())
        log(LogLevel::info, "changed parameters are kept: " + kept);
    past_.push_back(std::move(old));
    std::size_t memory = 0;
    std::size_t kept = 0;
    while (kept < past_.size() && kept < most) {
        memory += past_[past_.size() - 1 - kept].script->memory();
        if (kept > 0 && memory > most_memory) break;
        ++kept;
    }
    past_.erase(past_.begin(), past_.end() - static_cast<std::ptrdiff_t>(kept));
}

void ScriptComponent::go_back(bool keep_settings) {
    assert(!past_.empty());
    Version back = std::move(past_.back());
    past_.pop_back();
    const bool was_on_probation = !keep_settings || on_probation();
    // The reload ended the use of the parameter set.
    const bool set_went = !back.set.empty() && back.set != set_in_use() && back.uses == uses();
    const Parameters its = back.parameters;
    if (keep_settings) {
        back.parameters.adopt(parameters_);
    } else {
        back.parameters.adopt_from_outside(parameters_);
    }
    if (set_went) {
        note_set_in_use(back.set);
        for (const auto& [name, value] : sets.at(back.set)) {
            const auto* now = parameters_.find(name);
            const bool was_set = now != nullptr && (now->from_outside || (keep_settings && now->from_within));
            if (!was_set) back.parameters.adopt(its, name);
        }
    } else if (back.uses != uses()) {
        follow_use(*this, parameters_, keep_settings, back.parameters);
    }
    make_ports(back);
    fill_slots(back);
    probation_left_ = past_.empty() ? 0 : back.probation_left;
    // If the component was not activated again since then, the tasks of the version continue, and messages that were
    // dropped in a probation are put back. An activation starts all tasks and empties the ports.
    const bool is_same = back.activation == activation_;
    if (state() == LifeState::active && !is_same) back.script->tasks().start_all(now().seconds);
    std::vector<DroppedMessages> dropped = std::exchange(back.dropped, {});
    replace(std::move(back));
    if (is_same && was_on_probation) put_back(std::move(dropped));
}

void ScriptComponent::set_queue(InPortBase& port, std::size_t queue, Version& old) const {
    std::vector<AnyMessage> dropped = port.set_queue(queue);
    if (dropped.empty()) return;
    log(LogLevel::warn, fmt::format("input '{}' {} now: the oldest {} of {} unread messages were dropped", port.name(),
                                    queue > 0 ? fmt::format("has a queue of {}", queue) : "has no queue",
                                    dropped.size(), dropped.size() + std::max<std::size_t>(queue, 1)));
    old.dropped.push_back({port.name(), std::move(dropped)});
}

void ScriptComponent::put_back(std::vector<DroppedMessages> dropped) {
    for (DroppedMessages& each : dropped) {
        if (InPortBase* port = find_in_port(each.port)) port->put_back(std::move(each.messages));
    }
}

void ScriptComponent::begin_probation() {
    probation_left_ = probation;
    relapses_.clear();
}

Expected<void> ScriptComponent::execute_traced() {
    std::vector<LineTrace::Watched> lines;
    for (const auto& [owner, watched] : watched_) lines.insert(lines.end(), watched.begin(), watched.end());
    LineTrace trace({{"config", push_config_values}, {"state", push_state}}, std::move(lines));
    auto ok = script_->call(Hook::on_execute);
    latest_trace_ = trace.take();
    hits_ = trace.take_hits();
    add_texts(latest_trace_, *script_);
    traces_next_ = false;
    ++traces_;
    return ok;
}

void ScriptComponent::watch_lines(const void* owner, std::vector<LineTrace::Watched> lines) const {
    if (lines.empty()) {
        watched_.erase(owner);
    } else {
        watched_[owner] = std::move(lines);
    }
}

Expected<void> ScriptComponent::execute_measured() {
    const std::int64_t began = thread_time();
    std::int64_t hooks = 0;
    Expected<void> ok;
    {
        std::optional<LineProfile> lines;
        if (profile_->by_line) lines.emplace(profile_->lines);
        ok = execute_once();
        if (lines) hooks = lines->time_of_hooks();
    }
    profile_->add(thread_time() - began - hooks);
    return ok;
}

// Measures an execution, and logs a hint if the script is often slow.
Expected<void> ScriptComponent::execute_checked() {
    if (slow_executions_ < 0 || script_->context().budget.seconds > paced_budget.seconds) return execute_once();
    const std::int64_t began = thread_time();
    auto ok = execute_once();
    const double seconds = static_cast<double>(thread_time() - began) * 1e-9;
    const double tick = 1 / script_->context().tick_rate;
    constexpr double much = 0.25;  // of a tick
    constexpr int enough = 3;
    slow_executions_ = seconds > much * tick ? slow_executions_ + 1 : 0;
    if (slow_executions_ < enough) return ok;
    slow_executions_ = -1;
    log(LogLevel::info, fmt::format("an execution takes {:.1f} ms, {:.0f} % of a tick: profile(5, {}) at the console "
                                    "shows the time of each line",
                                    seconds * 1e3, 100 * seconds / tick, name()));
    return ok;
}

Expected<void> ScriptComponent::execute_on_probation() {
    if (!relapses_.empty() && !relapses_.back().went_back) return {};  // waits until the reload is undone
    // Each version executes in a separate `run`, so a replay knows which of them ran out of time.
    const auto execute = [this] { return run(Hook::on_execute, [this] { return script_->call(Hook::on_execute); }); };
    auto ok = execute();
    if (ok) {
        --probation_left_;
        return ok;
    }
    for (const auto& port : out_ports_) port->discard();
    const Version& before = past_.back();
    relapses_.push_back({.error = std::move(ok.error()),
                         .version = version_,
                         .execution = probation - probation_left_ + 1,
                         .reload = before.replaced_by});
    Relapse& relapse = relapses_.back();
    // If both versions have the same ports, the version before can run in this tick, unless this one was stopped at its
    // time limit. The measured time must not decide this, because equal runs would differ.
    if (relapse.error.kind == Error::Kind::out_of_time || !before.in_ports.empty() || !before.out_ports.empty() ||
        !ports_going(before).empty())
        return {};
    relapse.went_back = true;
    const bool is_late = script_->has_used_its_tick();
    go_back(false);
    const Budget budget = script_->context().budget;
    if (is_late) script_->set_budget({budget.seconds * Script::reserve});
    auto again = on_probation() ? execute_on_probation() : execute();
    script_->set_budget(budget);
    return again;
}

ScriptComponent::Version ScriptComponent::replace(Version next) {
    Version old;
    old.script = std::move(script_);
    old.number = version_;
    old.activation = activation_;
    old.probation_left = probation_left_;
    old.parameters = std::move(parameters_);
    old.in_ports = std::move(in_ports_);
    old.out_ports = std::move(out_ports_);
    if (old.script != nullptr) {
        old.script->go_live(false);
        old.script->probes().clear();
    }

    in_ports_.clear();
    out_ports_.clear();
    for (const PortDeclaration& declaration : next.script->ports()) {
        if (declaration.direction == Direction::in) {
            auto port = take_fitting(old.in_ports, declaration);
            if (port == nullptr) port = take_fitting(next.in_ports, declaration);
            port->set_doc(declaration.doc);
            set_queue(*port, declaration.queue, old);
            in_ports_.push_back(std::move(port));
        } else {
            auto port = take_fitting(old.out_ports, declaration);
            if (port == nullptr) port = take_fitting(next.out_ports, declaration);
            port->set_doc(declaration.doc);
            port->set_safe(declaration.safe.empty() ? default_safe(*declaration.type)
                                                    : std::optional<Value>(declaration.safe.front()));
            port->set_rate(rate);
            out_ports_.push_back(std::move(port));
        }
    }
    parameters_ = std::move(next.parameters);
    script_ = std::move(next.script);
    version_ = next.number;
    newest_ = std::max(newest_, version_);
    script_->go_live(true);
    if (old.script != nullptr) tell_early_log();  // for the first version, `set_log` does this
    for (const std::string& warning : next.warnings) log(LogLevel::warn, warning);
    return old;
}

void ScriptComponent::set_log(LogSink sink) {
    Component::set_log(std::move(sink));
    tell_early_log();
}

void ScriptComponent::tell_early_log() {
    for (const auto& [level, text] : script_->take_early_log()) log(level, text);
}

// Makes the ports of `next` that neither the running version nor `next` has yet.
void ScriptComponent::make_ports(Version& next) const {
    for (const PortDeclaration& declaration : next.script->ports()) {
        if (declaration.direction == Direction::in) {
            if (find_fitting(in_ports_, declaration) != in_ports_.end()) continue;
            if (find_fitting(next.in_ports, declaration) != next.in_ports.end()) continue;
            next.in_ports.push_back(
                make_in_port(declaration.type, declaration.name, declaration.doc, declaration.queue));
        } else {
            if (find_fitting(out_ports_, declaration) != out_ports_.end()) continue;
            if (find_fitting(next.out_ports, declaration) != next.out_ports.end()) continue;
            next.out_ports.push_back(make_out_port(declaration.type, declaration.name, declaration.doc));
        }
    }
}

void ScriptComponent::fill_slots(Version& next) const {
    for (PortSlot& slot : next.script->slots()) {
        const PortDeclaration& declaration = *slot.declaration;
        if (declaration.direction == Direction::in) {
            auto found = find_fitting(in_ports_, declaration);
            slot.port = found != in_ports_.end() ? found->get() : find_fitting(next.in_ports, declaration)->get();
        } else {
            auto found = find_fitting(out_ports_, declaration);
            slot.port = found != out_ports_.end() ? found->get() : find_fitting(next.out_ports, declaration)->get();
        }
    }
}

}  // namespace nezumi
