// Rates, and how they divide into ticks and physics steps.
#pragma once

#include <cstdint>

#include "engine/base/error.hpp"

namespace nezumi {

/// [Hz] Rates are whole numbers of micro-hertz. A tick shorter than a microsecond is a mistake.
inline constexpr double slowest_rate = 1e-6, fastest_rate = 1e6;

/// The number of physics steps of `physics_step` [s] in a tick at `rate` [Hz]. If it is not a whole number, an error
/// with the nearest rates.
Expected<int> steps_per_tick(double rate, double physics_step);

/// Whether something that runs at `rate` [Hz] is due in tick `k`, counted from 0, with `tick_rate` [Hz] ticks per
/// second: if floor(k * rate / tick_rate) grows. If it was due in one of the `left_out` skipped ticks before `k`, it is
/// due in `k`, once.
bool is_due(std::int64_t k, double rate, double tick_rate, std::int64_t left_out = 0);

}  // namespace nezumi
