// The descriptions of all messages and of what frames are made of, as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace nezumi::web {

/// { "Velocity2D": [ { "name": "vx", "type": "double", "unit": "m/s", "doc": "..." }, ... ], ... }: structures by name,
/// with their fields in the order in which CDR has them. A message type is its stamp and its data.
nlohmann::ordered_json types_to_json();

}  // namespace nezumi::web
