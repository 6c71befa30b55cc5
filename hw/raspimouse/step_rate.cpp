// A rate is a whole number of pulses per second, limited. Low rates are skipped while the speed changes.
#include "hw/raspimouse/step_rate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace nezumi::hw {

int StepRate::next(double speed, int held, double elapsed) {
    // Ticks are slightly irregular. After a gap the rate must not jump.
    constexpr double unevenness = 1.5;
    constexpr double longest_gap = 0.1;

    const double exact = std::isfinite(speed) ? speed / metres_per_pulse_ : 0;
    int rate = static_cast<int>(std::lround(std::clamp<double>(exact, -highest, highest)));
    const bool is_steady = std::exchange(asked_, rate) == rate;
    if (std::abs(rate) < lowest && !is_steady) return 0;

    const bool same_way = static_cast<long>(held) * rate > 0;
    const double gain = std::min<double>(
        highest, acceleration_ / metres_per_pulse_ * unevenness * std::clamp(elapsed, 0.0, longest_gap));
    const int most = std::max(at_once, (same_way ? std::abs(held) : 0) + static_cast<int>(gain));
    return std::clamp(rate, -most, most);
}

}  // namespace nezumi::hw
