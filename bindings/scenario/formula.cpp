// `and` is the minimum of its parts, `or` the maximum; parts that Lua did not evaluate do not count.
#include "bindings/scenario/formula.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace nezumi {

double of_result(bool result) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return result ? infinity : -infinity;
}

std::string_view to_text(Comparison::Operator op) {
    constexpr std::string_view texts[] = {"<", "<=", ">", ">=", "==", "~=", ""};
    return texts[static_cast<std::size_t>(op)];
}

std::string text_of(const Comparison& comparison) {
    if (comparison.op == Comparison::Operator::truth) return comparison.left;
    return fmt::format("{} {} {}", comparison.left, to_text(comparison.op), comparison.right);
}

double robustness_of(Comparison::Operator op, double left, double right, bool result) {
    if (left == right) return 0;  // also two equal infinities
    const double difference = right - left;
    if (std::isnan(difference)) return of_result(result);
    using enum Comparison::Operator;
    switch (op) {
        case less:
        case less_equal: return difference;
        case greater:
        case greater_equal: return -difference;
        case equal: return -std::abs(difference);
        case unequal: return std::abs(difference);
        case truth: break;
    }
    return of_result(result);
}

std::optional<Robustness> robustness_of(const Formula& formula, const Observed& observed) {
    switch (formula.kind) {
        case Formula::Kind::comparison: {
            const Comparison& comparison = observed.comparisons[formula.index];
            if (!comparison.evaluated) return std::nullopt;
            return Robustness{comparison.robustness, comparison.decided};
        }
        case Formula::Kind::constant: return Robustness{of_result(formula.value)};
        case Formula::Kind::local: return observed.decisions[formula.index].last_robustness;
        case Formula::Kind::negation: {
            const auto inner = robustness_of(formula.parts.front(), observed);
            if (!inner) return std::nullopt;
            return -*inner;
        }
        case Formula::Kind::conjunction:
        case Formula::Kind::disjunction: break;
    }
    const bool least = formula.kind == Formula::Kind::conjunction;
    std::optional<Robustness> found;
    for (const Formula& part : formula.parts) {
        const auto next = robustness_of(part, observed);
        // If two are equal, one that has a comparison decides.
        const bool takes = next && (!found || (least ? next->value < found->value : next->value > found->value) ||
                                    (next->value == found->value && found->decided == nullptr));
        if (takes) found = next;
    }
    return found;
}

void Observed::begin() {
    for (Comparison& comparison : comparisons) comparison.evaluated = comparison.has_numbers = false;
    for (Decision& decision : decisions) decision.last_robustness.reset();
    for (Robustness& nearest : nearest_) nearest = {of_result(true)};
    result_.reset();
}

void Observed::decide(std::size_t index, bool is_true) {
    Decision& decision = decisions[index];
    const auto robustness = robustness_of(decision.formula, *this).value_or(Robustness{of_result(is_true)});
    decision.last_robustness = robustness;
    if (decision.kind == Decision::Kind::result) {
        result_ = robustness;
        return;
    }
    if (decision.kind == Decision::Kind::branch) {
        const Robustness distance{std::abs(robustness.value), robustness.decided};
        for (const bool result : {false, true}) {
            // Skips a branch that was not taken and would have returned the same value.
            if (!is_true && decision.literal == result) continue;
            Robustness& nearest = nearest_[result ? 1 : 0];
            if (distance.value < nearest.value || nearest.decided == nullptr) nearest = distance;
        }
    }
    // A loop evaluates these comparisons again, and then must not see the old results.
    for (std::size_t i = decision.first; i < decision.last; ++i) comparisons[i].evaluated = false;
}

Robustness Observed::finish(bool result) {
    if (returns_only) decide(0, result);
    Robustness own = result_.value_or(Robustness{of_result(true)});
    own.value = std::abs(own.value);
    const Robustness& nearest = nearest_[result ? 1 : 0];
    if (nearest.value < own.value || (nearest.value == own.value && own.decided == nullptr)) own = nearest;
    return result ? own : -own;
}

}  // namespace nezumi
