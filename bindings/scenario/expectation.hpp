// What a scenario expects over time, apart from Lua: samples go in, a verdict comes out.
#pragma once

#include <limits>
#include <string>

#include "engine/base/error.hpp"

namespace nezumi {

enum class Verdict { open, kept, broken };

/// One `always`, `never`, `wait_until`, `eventually` or `maintain`. Times are simulated seconds.
class Expectation {
public:
    enum class Kind { always, never, wait_until, eventually, maintain };

    struct Terms {
        Kind kind = Kind::always;
        std::string name;
        Place place{};
        /// The event must come, and the hold begin, so long after the start at most; infinity: no such limit.
        double within = std::numeric_limits<double>::infinity();
        double hold = 0;  ///< of `maintain`
    };

    Expectation(Terms terms, double started) : terms_(std::move(terms)), started_(started) {}

    /// The condition is, or is not, true at this time. Times ascend. Only while the verdict is open.
    Verdict add_sample(bool is_true, double now);

    const Terms& terms() const { return terms_; }
    double started() const { return started_; }
    Verdict verdict() const { return verdict_; }
    /// "always 'never touches anything'".
    std::string title() const;
    /// What was expected and when it ceased, once it is broken.
    std::string explain() const;
    /// How far it had come when time ran out.
    std::string explain_open(double now) const;

private:
    Verdict sample_hold(bool is_true, double now);

    Terms terms_;
    double started_;
    Verdict verdict_ = Verdict::open;
    double broken_at_ = 0;
    double kept_until_ = -1;     // always, never: the last sample that was as expected
    double held_since_ = -1;     // maintain: when the present hold began, -1: it does not hold
    double longest_since_ = -1;  // and the longest so far
    double longest_until_ = -1;
};

/// "always", "wait_until", ...
std::string_view to_text(Expectation::Kind kind);

/// A time as messages show it: "3.12 s".
std::string text_of_time(double seconds);

/// Times that differ by less are the same: far below a tick, far above rounding.
inline constexpr double time_tolerance = 1e-7;

}  // namespace nezumi
