// An expectation of a scenario over time, independent of Lua: it takes samples and gives a verdict.
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
        /// The event must happen, or the hold must begin, at most this long after the start; infinity: no limit.
        double within = std::numeric_limits<double>::infinity();
        double hold = 0;  ///< for `maintain`
    };

    Expectation(Terms terms, double started) : terms_(std::move(terms)), started_(started) {}

    /// Adds the value of the condition at this time. Times must ascend. Call it only while the verdict is open.
    Verdict add_sample(bool is_true, double now);

    const Terms& terms() const { return terms_; }
    double started() const { return started_; }
    Verdict verdict() const { return verdict_; }
    /// "always 'never touches anything'".
    std::string title() const;
    /// What was expected and when it failed. Call it only if the verdict is `broken`.
    std::string explain() const;
    /// The progress of an expectation that is still open when the time is over.
    std::string explain_open(double now) const;

private:
    Verdict sample_hold(bool is_true, double now);

    Terms terms_;
    double started_;
    Verdict verdict_ = Verdict::open;
    double broken_at_ = 0;
    double kept_until_ = -1;     // always, never: the last sample that was as expected
    double held_since_ = -1;     // maintain: begin of the present hold; -1: it does not hold
    double longest_since_ = -1;  // begin of the longest hold so far
    double longest_until_ = -1;
};

/// "always", "wait_until", ...
std::string_view to_text(Expectation::Kind kind);

/// A time in messages: "3.12 s".
std::string text_of_time(double seconds);

/// Times that differ by less are equal: this is much less than a tick, and much more than rounding errors.
inline constexpr double time_tolerance = 1e-7;

}  // namespace nezumi
