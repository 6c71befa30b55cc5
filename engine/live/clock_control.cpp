// Limits of the clock's settings.
#include "engine/live/clock_control.hpp"

#include <fmt/format.h>

#include <cmath>

namespace nezumi {

Expected<double> check_speed(double factor) {
    if (factor == as_fast_as_possible || (factor >= slowest_speed && factor <= fastest_speed)) return factor;
    return failure(fmt::format("expected a factor from {} to {:.0f}, or \"max\", got {}{}", slowest_speed,
                               fastest_speed, factor, factor <= 0 ? "; pause() stops time" : ""));
}

Expected<std::int64_t> check_ticks(double ticks) {
    if (ticks >= 1 && ticks <= most_ticks && ticks == std::floor(ticks)) return static_cast<std::int64_t>(ticks);
    return failure(fmt::format("expected a whole number of ticks from 1 to {:.0f}, got {}", most_ticks, ticks));
}

}  // namespace nezumi
