// The description of a system for browsers: components, ports, parameters, wiring, arena, robots, drivers.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "engine/live/running_system.hpp"

namespace nezumi::web {

/// Everything that does not change from tick to tick.
nlohmann::ordered_json system_to_json(const RunningSystem& live);

/// A number that changes whenever the result of `system_to_json` may have changed; fast to compute.
std::uint64_t system_fingerprint(const RunningSystem& live);

}  // namespace nezumi::web
