// The descriptions of all message types and frame parts, as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace nezumi::web {

/// { "Velocity2D": [ { "name": "vx", "type": "double", "unit": "m/s", "doc": "..." }, ... ], ... }: structures by name,
/// with fields in CDR order. A message type consists of its time stamp and its data.
nlohmann::ordered_json types_to_json();

}  // namespace nezumi::web
