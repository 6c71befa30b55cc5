// The margin of an expectation over time, from the robustness of its condition in each sample: how far the condition is
// from changing between true and false.
#pragma once

#include <optional>
#include <string>

#include "bindings/scenario/condition.hpp"
#include "bindings/scenario/expectation.hpp"
#include "bindings/scenario/formula.hpp"
#include "bindings/scenario/run_result.hpp"

namespace nezumi {

/// - always: the least robustness; never: the least after its sign is changed.
/// - wait_until, eventually: the greatest until the event.
/// - maintain: the least during the hold. A hold that begins when its condition becomes true begins at the limit; this
///   is not a small margin, so samples do not count while the margin only grows from there. Without a hold that is long
///   enough: the one that ended the longest hold, or the greatest if there was no hold.
class MarginWatch {
public:
    /// Call it with each sample, after the expectation. `deadline` [s]: when the event must have happened.
    void add(const Expectation& expectation, const Robustness& robustness, bool is_true, double now, double deadline);

    /// How exact the robustness of the next sample must be; nothing: always exact.
    std::optional<LeastAsked> asked(Expectation::Kind kind) const;

    /// `why` is the reason if the numbers of the condition are unknown.
    ConditionMargin result(const Expectation& expectation, const std::string& why) const;

private:
    struct At {
        Robustness robustness{};
        double time = 0;
    };

    void keep_least(const Robustness& robustness, double now);
    void add_to_hold(const Robustness& robustness, bool is_true, double now);

    std::optional<At> nearest_;    // of the present hold, for maintain
    std::optional<At> best_;       // maintain: what ended the longest hold; before any hold, the greatest
    std::optional<double> left_;   // [s]
    std::optional<double> grows_;  // the margin of a hold while it only grows from the limit
    bool before_ = false;          // maintain: the sample before was true
    double began_ = 0;
    double longest_ = -1;
};

}  // namespace nezumi
