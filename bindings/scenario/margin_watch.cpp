// One rule for each kind of expectation.
#include "bindings/scenario/margin_watch.hpp"

#include <cmath>

namespace nezumi {

void MarginWatch::keep_least(const Robustness& robustness, double now) {
    if (!nearest_ || robustness.value < nearest_->robustness.value) nearest_ = {robustness, now};
}

void MarginWatch::add_to_hold(const Robustness& robustness, bool is_true, double now) {
    if (is_true && !before_) {
        began_ = now;
        nearest_.reset();
    }
    if (is_true) {
        const bool only_grows = grows_ && robustness.value >= *grows_;
        grows_ = only_grows ? std::optional(robustness.value) : std::nullopt;
        if (only_grows) nearest_ = {robustness, now};
        keep_least(robustness, now);
    } else {
        grows_ = 0;
        const double length = before_ ? now - began_ : -1;
        const bool is_longest = before_ && length > longest_;
        const bool is_nearer = longest_ < 0 && (!best_ || robustness.value > best_->robustness.value);
        if (is_longest || (!before_ && is_nearer)) best_ = {robustness, now};
        if (is_longest) longest_ = length;
    }
    before_ = is_true;
}

void MarginWatch::add(const Expectation& expectation, const Robustness& robustness, bool is_true, double now,
                      double deadline) {
    switch (expectation.terms().kind) {
        case Expectation::Kind::always: keep_least(robustness, now); break;
        case Expectation::Kind::never: keep_least(-robustness, now); break;
        case Expectation::Kind::wait_until:
        case Expectation::Kind::eventually:
            if (!nearest_ || robustness.value > nearest_->robustness.value) nearest_ = {robustness, now};
            if (is_true) left_ = deadline - now;
            break;
        case Expectation::Kind::maintain:
            add_to_hold(robustness, is_true, now);
            if (expectation.verdict() == Verdict::kept) left_ = deadline - began_;
            break;
    }
}

std::optional<LeastAsked> MarginWatch::asked(Expectation::Kind kind) const {
    if (kind != Expectation::Kind::always && kind != Expectation::Kind::never) return std::nullopt;
    LeastAsked asked{.opposite = kind == Expectation::Kind::never};
    if (nearest_) asked.least = nearest_->robustness.value;
    return asked;
}

ConditionMargin MarginWatch::result(const Expectation& expectation, const std::string& why) const {
    ConditionMargin result{.kind = std::string(to_text(expectation.terms().kind)),
                           .condition = expectation.terms().name};
    if (left_) result.left = *left_ > time_tolerance ? *left_ : 0;
    const bool is_hold = expectation.terms().kind == Expectation::Kind::maintain;
    const auto& found = is_hold && expectation.verdict() != Verdict::kept ? best_ : nearest_;
    if (!found) {
        result.why = nearest_ ? "the run ended during the hold" : "the condition was not evaluated";
        return result;
    }
    result.time = found->time;
    const Robustness& robustness = found->robustness;
    if (std::isfinite(robustness.value)) {
        result.margin = robustness.value + 0.0;  // not -0
        if (robustness.decided != nullptr) {
            result.unit = robustness.decided->unit;
            result.comparison = text_of(*robustness.decided);
        }
    } else if (result.left) {
        result.margin = result.left;
        result.unit = "s";
    } else {
        result.why = why.empty() ? why_without_numbers(robustness) : why;
    }
    return result;
}

}  // namespace nezumi
