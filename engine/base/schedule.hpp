// Rates: how they divide into ticks and physics steps.
#pragma once

#include <cstdint>

#include "engine/base/error.hpp"

namespace nezumi {

/// [Hz] Rates are whole numbers of micro-hertz; a tick that takes less than a microsecond is a slip.
inline constexpr double slowest_rate = 1e-6, fastest_rate = 1e6;

/// How many physics steps of `physics_step` [s] make a tick at `rate` [Hz]. When that is no whole number, an error that
/// names the nearest rates.
Expected<int> steps_per_tick(double rate, double physics_step);

/// Whether what runs at `rate` [Hz] is due in tick `k`, from 0, where `tick_rate` [Hz] ticks are a second: when
/// floor(k * rate / tick_rate) grows. What was due in one of the `left_out` ticks before `k` is due in `k`, once.
bool is_due(std::int64_t k, double rate, double tick_rate, std::int64_t left_out = 0);

}  // namespace nezumi
