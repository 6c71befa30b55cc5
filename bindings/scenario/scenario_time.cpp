// Lets time pass in a run: tick, evaluate every condition, decide.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bindings/scenario/scenario_run.hpp"
#include "engine/live/live_text.hpp"
#include "engine/trace/text_plot.hpp"

namespace nezumi {

// Ends the run, because its recording has ended.
bool ScenarioRun::stop_at_end(const Watched* waiting) {
    std::string text = fmt::format("the recording has ended, at {}", text_of_time(worlds_.now()));
    if (waiting != nullptr) text += "; " + waiting->expectation.explain_open(worlds_.now());
    stop(RunOutcome::failed, {text, waiting != nullptr ? waiting->expectation.terms().place : scenario_.place});
    if (waiting != nullptr) tell_plot(*waiting);
    return false;
}

bool ScenarioRun::advance(lua_State* lua, const Watched* waiting) {
    if (std::isinf(worlds_.next())) return stop_at_end(waiting);
    if (worlds_.next() > scenario_.timeout + time_tolerance) {
        std::string text = fmt::format("timeout: the scenario takes longer than {} of simulated time",
                                       text_of_time(scenario_.timeout));
        if (waiting != nullptr) text += "; " + waiting->expectation.explain_open(worlds_.now());
        stop(RunOutcome::failed, {text, waiting != nullptr ? waiting->expectation.terms().place : scenario_.place});
        if (waiting != nullptr) tell_ports(read_ports_);
        if (waiting != nullptr) tell_plot(*waiting);
        return false;
    }
    faults_.end_due(worlds_.now());
    const auto ticked = worlds_.step();
    if (!ticked) {
        stop(RunOutcome::could_not_run, ticked.error());
        return false;
    }
    if (ticked->empty()) return stop_at_end(waiting);
    if (settings_.files != nullptr) {
        for (const std::size_t world : *ticked) settings_.files->after_tick(world);
    }
    for (Golden& golden : goldens_) golden.add(worlds_.now());
    if (!check_components()) return false;
    for (const auto& watch : watches_) {
        if (!sample(lua, *watch)) return false;
    }
    return true;
}

bool ScenarioRun::sample(lua_State* lua, Watched& watched) {
    read_ports_.clear();
    watched.sampled = true;
    Condition& condition = *watched.condition;
    sampling_ = true;
    const auto asked = watched.margin.asked(watched.expectation.terms().kind);
    const auto is_true = condition.sample(lua, asked ? &*asked : nullptr);
    sampling_ = false;
    if (stopped_) return false;
    if (!is_true) {
        fail(is_true.error(), watched);
        return false;
    }
    const double now = worlds_.now();
    const auto& comparisons = condition.comparisons();
    if (settings_.keep_history) {
        watched.history.resize(comparisons.size());
        for (std::size_t i = 0; i < comparisons.size(); ++i) {
            if (comparisons[i].has_numbers)
                watched.history[i].push_back({now, comparisons[i].left_value, comparisons[i].right_value});
        }
    }
    const Expectation& expectation = watched.expectation;
    const Verdict verdict = watched.expectation.add_sample(*is_true, now);
    const double deadline = std::min(expectation.started() + expectation.terms().within, scenario_.timeout);
    watched.margin.add(expectation, condition.robustness(), *is_true, now, deadline);
    if (verdict == Verdict::broken) fail(watched);
    return verdict != Verdict::broken;
}

bool ScenarioRun::pass_time(lua_State* lua, double seconds) {
    // The end of s:run may have been between two ticks; then the rest counts from there.
    const double from = asked_until_ > worlds_.now() && asked_until_ < worlds_.next() ? asked_until_ : worlds_.now();
    asked_until_ = from + seconds;
    if (!check_components()) return false;
    while (worlds_.next() <= asked_until_ + time_tolerance) {
        if (!advance(lua, nullptr)) return false;
    }
    const bool is_short = std::isinf(worlds_.next()) && worlds_.now() < asked_until_ - time_tolerance;
    return is_short ? stop_at_end(nullptr) : true;
}

bool ScenarioRun::wait(lua_State* lua, Watched& watched) {
    if (!check_components()) return false;
    // A condition that is already true needs no tick. Before the first tick there is nothing to evaluate.
    if (worlds_.ticks() > 0 && !sample(lua, watched)) return false;
    while (watched.expectation.verdict() == Verdict::open) {
        if (!advance(lua, &watched) || !sample(lua, watched)) return false;
    }
    return true;
}

// After a component goes to ERROR, the run no longer tests it, so the run ends.
bool ScenarioRun::check_components() {
    for (std::size_t i = 0; i < worlds_.size(); ++i) {
        const RunningSystem& live = worlds_[i];
        for (const auto& component : live.system().components()) {
            if (component->state() != LifeState::error) continue;
            if (allowed_errors_.contains({&live, component->name()})) continue;
            const Error& error = component->last_error();
            const std::string text = fmt::format("{} went to ERROR: {}", component->name(), one_line(error.message));
            if (stopped_) {
                result_.facts.push_back("also " + describe(Error{text, error.place}));
                continue;
            }
            stop(RunOutcome::failed, {text, error.place});
            result_.component_failed = true;
            result_.facts.push_back(
                fmt::format("to let the scenario continue, call s:allow_error(\"{}\") before", component->name()));
        }
    }
    return !stopped_;
}

void ScenarioRun::stop(RunOutcome outcome, Error error) {
    if (stopped_) return;
    stopped_ = true;
    result_.outcome = outcome;
    result_.error = std::move(error);
    if (!worlds_.empty()) result_.facts.push_back(fmt::format("at {} of simulated time", text_of_time(worlds_.now())));
}

void ScenarioRun::fail(const Watched& watched) {
    if (stopped_) return;
    const Expectation& expectation = watched.expectation;
    stop(RunOutcome::failed, {expectation.explain(), expectation.terms().place});
    const std::string reason = watched.condition->reason();
    if (!reason.empty()) result_.facts.push_back(reason);
    tell_ports(read_ports_);
    tell_plot(watched);
}

void ScenarioRun::fail(const CallError& error, const Watched& watched) {
    if (stopped_) return;
    Error plain{watched.expectation.title() + ": " + error.message, error.place};
    if (plain.place.file.empty()) plain.place = watched.expectation.terms().place;
    const bool could_not = error.over_budget || is_setup_error(error);
    stop(could_not ? RunOutcome::could_not_run : RunOutcome::failed, std::move(plain));
    tell_ports(read_ports_);
}

void ScenarioRun::tell_ports(const std::vector<PortAt>& ports) {
    std::vector<const Port*> told;
    const auto tell = [&](const RunningSystem& live, const Component& component, const Port& port) {
        constexpr std::size_t most = 12;
        for (const Port* other : told) {
            if (other == &port) return;
        }
        if (told.size() == most) return;
        told.push_back(&port);
        result_.facts.push_back("  " + port_text(live.system(), component, port));
    };
    for (const PortAt& at : ports) tell(*at.live, *at.component, *at.port);
    if (!told.empty()) return;
    // The condition has read no port, so all published values are shown.
    for (std::size_t i = 0; i < worlds_.size(); ++i) {
        const RunningSystem& live = worlds_[i];
        for (const auto& component : live.system().components()) {
            for (const auto& port : component->out_ports()) tell(live, *component, *port);
        }
    }
}

void ScenarioRun::tell_plot(const Watched& watched) {
    constexpr PlotSize size{.columns = 64, .rows = 8};
    const auto& comparisons = watched.condition->comparisons();
    for (std::size_t i = 0; i < watched.history.size(); ++i) {
        const Comparison& comparison = comparisons[i];
        Curve limit{.name = comparison.right, .mark = '-'};
        Curve value{.name = comparison.left};
        for (const Watched::Sample& sample : watched.history[i]) {
            limit.points.emplace_back(sample.time, sample.right);
            value.points.emplace_back(sample.time, sample.left);
        }
        for (const std::string& line : plain_plot({limit, value}, size)) result_.facts.push_back("  " + line);
    }
}

}  // namespace nezumi
