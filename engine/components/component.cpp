// The transitions of the life cycle, and the safe values that they write.
#include "engine/components/component.hpp"

#include <fmt/format.h>

namespace nezumi {

std::string_view to_text(LogLevel level) {
    constexpr std::string_view names[] = {"debug", "info", "warn", "error"};
    return names[static_cast<int>(level)];
}

std::string_view to_text(LifeState state) {
    constexpr std::string_view names[] = {"INACTIVE", "ACTIVE", "ERROR"};
    return names[static_cast<int>(state)];
}

std::string_view to_text(Hook hook) {
    constexpr std::string_view names[] = {
        "", "on_activated", "on_execute", "on_deactivated", "on_aborting", "on_error", "on_reset", "on_reload", ""};
    return names[static_cast<int>(hook)];
}

const std::vector<std::string_view>& hook_names() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> all;
        for (int i = static_cast<int>(Hook::on_activated); i <= static_cast<int>(Hook::on_reload); ++i) {
            all.push_back(to_text(static_cast<Hook>(i)));
        }
        return all;
    }();
    return names;
}

const InPortBase* Component::find_in_port(std::string_view name) const {
    for (const auto& port : in_ports_) {
        if (port->name() == name) return port.get();
    }
    return nullptr;
}

const OutPortBase* Component::find_out_port(std::string_view name) const {
    for (const auto& port : out_ports_) {
        if (port->name() == name) return port.get();
    }
    return nullptr;
}

const Port* Component::find_port(std::string_view name) const {
    if (const Port* port = find_in_port(name)) return port;
    return find_out_port(name);
}

Expected<void> Component::use(std::string_view set) {
    const auto found = sets.find(set);
    const bool is_none = set == no_set;
    if (found == sets.end() && !is_none) {
        std::vector<std::string_view> names;
        for (const auto& [name, values] : sets) names.push_back(name);
        names.push_back(no_set);
        return failure(fmt::format("{} has no parameter set '{}'{}", name_, shown(set), did_you_mean(set, names)));
    }
    ParameterValues values = is_none ? ParameterValues() : found->second;
    for (const auto& [name, value] : configured) {
        // A configured value that no longer fits after a reload does not prevent leaving a set.
        const auto* parameter = parameters_.find(name);
        if (is_none && (parameter == nullptr || !check_value(parameter->spec, value))) continue;
        values.emplace(name, value);
    }
    if (auto ok = parameters_.set_all(values); !ok)
        return failure(fmt::format("set '{}': {}", shown(set), ok.error().message));
    for (const auto& [name, other] : sets) {
        for (const auto& [parameter, value] : other) {
            if (!values.contains(parameter)) parameters_.follow_default(parameter);
        }
    }
    set_in_use_ = is_none ? "" : found->first;
    ++uses_;
    return {};
}

void Component::note_out_of_time(OutOfTime ended) {
    constexpr std::size_t most = 16;
    out_of_time_ = ended.error;
    // A call that ended because an inner call ended does not count separately.
    const bool follows = !new_out_of_time_.empty() && new_out_of_time_.back().call > ended.call;
    if (!follows && new_out_of_time_.size() < most) new_out_of_time_.push_back(std::move(ended));
}

void Component::log(LogLevel level, std::string text) const {
    if (log_) log_({level, now_.seconds, name_, std::move(text)});
}

Expected<void> Component::activate(const Time& now) {
    if (state_ == LifeState::active) return {};
    if (state_ == LifeState::error) return failure(fmt::format("{} is in ERROR: reset it first", name_));
    now_ = now;
    for (const auto& port : in_ports_) port->clear();
    parameters_.take_staged();
    executed_at_ = -1;
    state_ = LifeState::active;
    auto ok = run(Hook::on_activated, [this] { return on_activated(); });
    if (!ok) {
        abort(ok.error());
        return failure(fmt::format("{} went to ERROR: {}", name_, describe(ok.error())));
    }
    return {};
}

Expected<void> Component::deactivate(const Time& now) {
    if (state_ == LifeState::inactive) return {};
    if (state_ == LifeState::error) return failure(fmt::format("{} is in ERROR: reset it first", name_));
    now_ = now;
    parameters_.take_staged();
    for (const auto& port : out_ports_) port->discard();
    auto ok = run(Hook::on_deactivated, [this] { return on_deactivated(); });
    if (!ok) {
        abort(ok.error());
        return failure(fmt::format("{} went to ERROR: {}", name_, describe(ok.error())));
    }
    state_ = LifeState::inactive;
    for (const auto& port : out_ports_) {
        if (!port->written()) port->write_safe();
    }
    return {};
}

Expected<void> Component::reset(const Time& now) {
    if (state_ != LifeState::error)
        return failure(fmt::format("{} is {}: only a component in ERROR can be reset", name_, to_text(state_)));
    now_ = now;
    auto ok = run(Hook::on_reset, [this] { return on_reset(); });
    if (!ok) {
        last_error_ = ok.error();
        failed_at_ = now_.seconds;
        return failure(fmt::format("{} stays in ERROR: {}", name_, describe(ok.error())));
    }
    for (const auto& port : in_ports_) port->clear();
    state_ = LifeState::inactive;
    return {};
}

Value Component::configured_value(const ParameterSpec& spec) const {
    const auto in_use = sets.find(set_in_use_);
    for (const ParameterValues* values : {in_use != sets.end() ? &in_use->second : nullptr, &configured}) {
        if (values == nullptr) continue;
        const auto found = values->find(spec.name);
        if (found == values->end()) continue;
        if (auto value = check_value(spec, found->second)) return std::move(*value);
    }
    return spec.initial;
}

Expected<PlainData> Component::call_command(std::string_view command, const PlainData& /*arguments*/,
                                            const Time& /*now*/) {
    return failure(fmt::format("{} has no command '{}'", name_, shown(command)));
}

void Component::execute(const Time& now) {
    if (state_ == LifeState::inactive) return;
    now_ = now;
    if (state_ == LifeState::error) {
        if (error_hook_failed_) return;
        if (auto ok = run_without_velocities(Hook::on_error); !ok) {
            // Reported once. The error that led to ERROR stays the reason.
            error_hook_failed_ = true;
            log(LogLevel::error,
                fmt::format("on_error failed and is not called again before a reset: {}", describe(ok.error())));
        }
        return;
    }
    dt_ = executed_at_ < 0 ? 1.0 / (rate > 0 ? rate : tick_rate_) : now.seconds - executed_at_;
    executed_at_ = now.seconds;
    ++executions_;
    if (auto ok = run(Hook::on_execute, [this] { return on_execute(); }); !ok) abort(std::move(ok.error()));
}

void Component::latch_inputs(const Time& now) {
    parameters_.take_staged();
    for (const auto& port : in_ports_) {
        const std::uint64_t dropped_before = port->dropped();
        port->latch(now);
        if (port->dropped() > dropped_before && port->tells_overflow()) {
            log(LogLevel::warn,
                fmt::format("input '{}': its queue of {} is full, the oldest message was dropped (reported once)",
                            port->name(), port->queue()));
        }
    }
}

void Component::abort(Error error) {
    for (const auto& port : out_ports_) port->discard();
    state_ = LifeState::error;
    error_hook_failed_ = false;
    log(LogLevel::error, describe(error));
    last_error_ = std::move(error);
    failed_at_ = now_.seconds;
    if (auto ok = run_without_velocities(Hook::on_aborting); !ok) {
        for (const auto& port : out_ports_) port->discard();
        log(LogLevel::error, fmt::format("{} failed: {}", failed_at_aborting(), describe(ok.error())));
    }
    for (const auto& port : out_ports_) port->write_safe();
}

// Discards only the velocities that the hook wrote: a safe value that an earlier failure between two ticks wrote, and
// that is not published yet, must stay.
Expected<void> Component::run_without_velocities(Hook hook) {
    std::vector<std::size_t> before;
    for (const auto& port : out_ports_) before.push_back(port->pending());
    auto ok = run(hook, [&] { return hook == Hook::on_aborting ? on_aborting() : on_error(); });
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (out_ports_[i]->type() == message_of<Velocity2D>()) out_ports_[i]->discard_after(before[i]);
    }
    return ok;
}

}  // namespace nezumi
