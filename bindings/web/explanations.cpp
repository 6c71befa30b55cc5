// Past executions are computed one after the other, between two ticks.
#include "bindings/web/explanations.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "bindings/web/explain_json.hpp"
#include "engine/base/json_text.hpp"

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::chrono::milliseconds least{2};  // computation in one call, at least

}  // namespace

Expected<void> Explanations::ask(ClientId client, const std::string& component) {
    if (asked_.size() >= most) return failure("too many explanations are already waiting");
    Asked asked{.client = client, .component = component, .generation = live_.generation()};
    const Component* const its = std::as_const(live_).system().find(component);
    const bool is_script = its != nullptr && its->script_file() != nullptr;
    const bool has_failed = is_script && its->state() == LifeState::error;
    const bool has_executed = is_script && its->executed_at() >= 0;
    asked.is_over = !clock_.is_hardware() && (has_failed || (clock_.is_paused() && has_executed));
    if (!asked.is_over) {
        const auto trace = live_.explain_next(component);
        if (!trace) return Unexpected(trace.error());
        asked.trace = *trace;
        tell_of_pause(asked);
    }
    asked_.push_back(std::move(asked));
    return {};
}

void Explanations::forget(ClientId client) {
    std::erase_if(asked_, [client](const Asked& each) { return each.client == client; });
}

bool Explanations::serve(Clock::time_point until) {
    take_stepped();
    bool computes = false;
    std::erase_if(asked_, [&](Asked& each) { return is_answered(each, until, computes); });
    return computes;
}

bool Explanations::is_answered(Asked& asked, Clock::time_point until, bool& computes) {
    if (asked.generation != live_.generation()) {
        tell(asked, failure(asked.component + " was replaced by a restart or a seek"));
        return true;
    }
    if (asked.is_over) return is_computed(asked, until, computes);
    const auto seen = live_.explanation(asked.component, asked.trace);
    if (seen && !*seen) return false;
    tell(asked, seen ? Expected<Explanation>(**seen) : Unexpected(seen.error()));
    return true;
}

bool Explanations::is_computed(Asked& asked, Clock::time_point until, bool& computes) {
    if (computes) return false;
    if (is_known(asked.component)) {
        tell(asked, *known_);
        return true;
    }
    if (asked.past == nullptr) {
        auto past = PastExecution::begin(live_, asked.component);
        if (!past) return waits_for_next(asked, past.error());
        asked.past = std::move(*past);
    }
    const auto there = asked.past->run().go_on(std::max(until, Clock::now() + least));
    computes = there && !*there;
    if (computes) return false;
    const auto seen = there ? asked.past->explain() : Unexpected(there.error());
    if (seen) {
        known_ = *seen;
        known_generation_ = live_.generation();
        look_ahead(asked.component);
    }
    tell(asked, seen);
    return true;
}

// If the past of the system can't be computed, explains the next execution instead.
bool Explanations::waits_for_next(Asked& asked, const Error& why) {
    const auto trace = live_.explain_next(asked.component);
    if (!trace) {
        tell(asked, Unexpected(why));
        return true;
    }
    asked.is_over = false;
    asked.trace = *trace;
    tell_of_pause(asked);
    return false;
}

void Explanations::tell_of_pause(const Asked& asked) {
    if (clock_.is_paused())
        send_(asked.client, json_text(Json{{"is", "explain"}, {"component", asked.component}, {"waits", true}}));
}

void Explanations::look_ahead(const std::string& component) {
    ahead_.reset();
    if (const auto trace = live_.explain_next(component))
        ahead_ = Asked{.component = component, .generation = live_.generation(), .trace = *trace};
}

void Explanations::take_stepped() {
    if (!ahead_) return;
    if (ahead_->generation != live_.generation()) return ahead_.reset();
    const auto seen = live_.explanation(ahead_->component, ahead_->trace);
    if (seen && !*seen) return;
    const std::string component = std::exchange(ahead_, {})->component;
    // Uses the explanation only if no tick has followed: otherwise its values of ports are those of a later tick.
    if (!seen || !clock_.is_paused() || (*seen)->tick + 1 != live_.system().now().tick) return;
    known_ = **seen;
    known_generation_ = live_.generation();
    look_ahead(component);
}

bool Explanations::is_known(const std::string& component) const {
    const Component* const its = std::as_const(live_).system().find(component);
    return known_ && its != nullptr && known_generation_ == live_.generation() && known_->component == component &&
           known_->seconds == its->executed_at();
}

void Explanations::tell(const Asked& asked, const Expected<Explanation>& explained) {
    send_(asked.client, explained ? json_text(explanation_to_json(*explained))
                                  : json_text(Json{{"is", "explain"},
                                                   {"component", asked.component},
                                                   {"problem", explained.error().message + ": not explained"}}));
}

}  // namespace nezumi::web
