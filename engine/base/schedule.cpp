// Exact arithmetic of rates.
#include "engine/base/schedule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nezumi {
namespace {

constexpr double most_steps = 1e6;  // of physics in a tick

// Rates as whole micro-hertz, so that "due" is exact.
std::uint64_t micro(double rate) { return static_cast<std::uint64_t>(std::llround(rate * 1e6)); }

// a * b modulo m, for a < m < 2^63: exact also if the product has more than 64 bits.
std::uint64_t product_modulo(std::uint64_t a, std::uint64_t b, std::uint64_t m) {
    if (b == 0 || a <= std::numeric_limits<std::uint64_t>::max() / b) return a * b % m;
    std::uint64_t sum = 0;
    for (; b > 0; b /= 2, a = 2 * a % m) {
        if (b % 2 == 1) sum = (sum + a) % m;
    }
    return sum;
}

}  // namespace

Expected<int> steps_per_tick(double rate, double physics_step) {
    if (!std::isfinite(rate) || rate <= 0) return failure(fmt::format("rate: {} Hz is not a positive number", rate));
    if (!std::isfinite(physics_step) || physics_step <= 0) {
        return failure(fmt::format("physics: a step of {} s is not a positive number", physics_step));
    }
    const double steps = 1.0 / (rate * physics_step);
    const double whole = std::round(steps);
    if (whole >= 1 && whole <= most_steps && std::abs(steps - whole) < 1e-9 * whole) {
        if (rate >= slowest_rate && rate <= fastest_rate) return static_cast<int>(whole);
        return failure(fmt::format("rate: expected from {} to {} Hz, got {}", slowest_rate, fastest_rate, rate));
    }
    // Prints all digits, because the user may copy the number into a file.
    const auto rate_of = [&](double n) { return fmt::format("{}", 1.0 / (n * physics_step)); };
    const double slower = std::clamp(std::ceil(steps), 1.0, most_steps);
    const double faster = std::clamp(std::floor(steps), 1.0, most_steps);
    const std::string nearest =
        slower == faster ? fmt::format("the nearest rate is {} Hz", rate_of(slower))
                         : fmt::format("the nearest rates are {} or {} Hz", rate_of(slower), rate_of(faster));
    return failure(fmt::format("rate: a tick of {} Hz is not a whole number of physics steps of {} s{}; {}", rate,
                               physics_step, steps > most_steps ? fmt::format(" up to {}", most_steps) : "", nearest));
}

bool is_due(std::int64_t k, double rate, double tick_rate, std::int64_t left_out) {
    if (rate <= 0 || rate >= tick_rate || k <= left_out) return true;
    const std::uint64_t component = micro(rate);
    const std::uint64_t tick = micro(tick_rate);
    // floor(k * rate / tick_rate) has grown in the last `ticks` ticks if the remainder is less than ticks * component.
    const std::uint64_t ticks = static_cast<std::uint64_t>(left_out) + 1;
    if (ticks > tick / component) return true;
    return product_modulo(static_cast<std::uint64_t>(k) % tick, component, tick) < ticks * component;
}

}  // namespace nezumi
