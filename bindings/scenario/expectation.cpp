// The rules of each kind, and the messages about failures.
#include "bindings/scenario/expectation.hpp"

#include <fmt/format.h>

namespace nezumi {

std::string_view to_text(Expectation::Kind kind) {
    constexpr std::string_view texts[] = {"always", "never", "wait_until", "eventually", "maintain"};
    return texts[static_cast<std::size_t>(kind)];
}

std::string text_of_time(double seconds) {
    // Times have two digits, enough for ticks of 100 Hz; other times have more digits, down to a microsecond.
    std::string text = fmt::format("{:.6f}", seconds);
    while (text.back() == '0' && text[text.size() - 3] != '.') text.pop_back();
    return text + " s";
}

Verdict Expectation::add_sample(bool is_true, double now) {
    const bool late = now >= started_ + terms_.within - time_tolerance;
    switch (terms_.kind) {
        case Kind::always:
        case Kind::never:
            if (is_true != (terms_.kind == Kind::always)) {
                verdict_ = Verdict::broken;
            } else {
                kept_until_ = now;
            }
            break;
        case Kind::wait_until:
        case Kind::eventually:
            if (is_true) {
                verdict_ = Verdict::kept;
            } else if (late) {
                verdict_ = Verdict::broken;
            }
            break;
        case Kind::maintain: verdict_ = sample_hold(is_true, now); break;
    }
    if (verdict_ == Verdict::broken) broken_at_ = now;
    return verdict_;
}

Verdict Expectation::sample_hold(bool is_true, double now) {
    if (!is_true) {
        held_since_ = -1;
        return now >= started_ + terms_.within - time_tolerance ? Verdict::broken : Verdict::open;
    }
    if (held_since_ < 0) {
        // A hold that begins too late does not count.
        if (now > started_ + terms_.within + time_tolerance) return Verdict::broken;
        held_since_ = now;
    }
    if (longest_since_ < 0 || now - held_since_ > longest_until_ - longest_since_) {
        longest_since_ = held_since_;
        longest_until_ = now;
    }
    return now - held_since_ >= terms_.hold - time_tolerance ? Verdict::kept : Verdict::open;
}

std::string Expectation::title() const { return fmt::format("{} '{}'", to_text(terms_.kind), terms_.name); }

std::string Expectation::explain() const {
    const auto span = [&](double seconds) { return text_of_time(seconds); };
    switch (terms_.kind) {
        case Kind::always:
            if (kept_until_ < 0)
                return fmt::format("{} did not hold at its first sample, at {}", title(), span(broken_at_));
            return fmt::format("{} held until {} and failed at {}", title(), span(kept_until_), span(broken_at_));
        case Kind::never: return fmt::format("{} happened at {}", title(), span(broken_at_));
        case Kind::wait_until:
        case Kind::eventually:
            return fmt::format("{} did not happen within {}: waited from {} to {}", title(), span(terms_.within),
                               span(started_), span(broken_at_));
        case Kind::maintain: break;
    }
    if (longest_since_ < 0) {
        return fmt::format("{} did not begin within {}: waited from {} to {}", title(), span(terms_.within),
                           span(started_), span(broken_at_));
    }
    return fmt::format("{} held for only {} of {}, from {} to {}, and no later hold began within {}", title(),
                       span(longest_until_ - longest_since_), span(terms_.hold), span(longest_since_),
                       span(longest_until_), span(terms_.within));
}

std::string Expectation::explain_open(double now) const {
    if (terms_.kind == Kind::maintain && held_since_ >= 0) {
        return fmt::format("{} had held for {} of {}", title(), text_of_time(now - held_since_),
                           text_of_time(terms_.hold));
    }
    return fmt::format("{} had not happened since {}", title(), text_of_time(started_));
}

}  // namespace nezumi
