// Rates: how they divide into ticks and physics steps.
#pragma once

#include <cstdint>

#include "engine/base/error.hpp"

namespace nezumi {

/// How many physics steps make a tick, or an error that names the nearest rates when the tick is no whole number of
/// steps.
Expected<int> steps_per_tick(double rate, double physics_step);

/// Whether component `rate` [Hz] is due in tick `k` of ticks at `tick_rate` [Hz]: when floor(k * rate / tick_rate)
/// grows.
bool is_due(std::int64_t k, double rate, double tick_rate);

}  // namespace nezumi
