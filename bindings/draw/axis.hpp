// The axis of a plot: the range of values, and round steps for its labels.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace nezumi::draw {

struct AxisRange {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void include(double value) {
        if (!std::isfinite(value)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    /// Makes the range longer by the fraction `part` at both ends. A range of one value is extended by at least
    /// `least`, an empty one becomes 0 to 1 first.
    void widen(double part, double least) {
        if (low > high) low = 0, high = 1;
        const double more = std::max((high - low) * part, high - low > 0 ? 0 : std::max(least, std::abs(low) * 0.1));
        low -= more;
        high += more;
    }
};

/// Returns a round step that divides a range into about `count` parts.
inline double round_step(const AxisRange& range, int count) {
    const double least = (range.high - range.low) / count;
    const double power = std::pow(10, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= least) return factor * power;
    }
    return 10 * power;
}

}  // namespace nezumi::draw
