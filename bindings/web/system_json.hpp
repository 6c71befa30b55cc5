// A system as browsers are told it: components, ports, parameters, wiring, arena, robots, who drives.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "engine/live/running_system.hpp"

namespace nezumi::web {

/// All but what changes from tick to tick.
nlohmann::ordered_json system_to_json(const RunningSystem& live);

/// Another number when `system_to_json` may have changed; cheap.
std::uint64_t system_fingerprint(const RunningSystem& live);

}  // namespace nezumi::web
