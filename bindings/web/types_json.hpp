// The descriptions of all message types and frame parts, as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/system/system.hpp"

namespace nezumi::web {

/// { "Velocity2D": [ { "name": "vx", "type": "double", "unit": "m/s", "doc": "..." }, ... ], ... }: structures by name,
/// with fields in CDR order. A message type consists of its time stamp and its data.
nlohmann::ordered_json types_to_json();

/// The message types of the system's ports that files define, with their structures. An array is "array<TYPE,N>", an
/// enumeration "enum<CHOICE,...>".
nlohmann::ordered_json defined_types_to_json(const System& system);

}  // namespace nezumi::web
