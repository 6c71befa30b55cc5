// Merges the fields of two tables, for a robot that differs from the robot that it builds on.
#pragma once

#include "bindings/lua/files/file_value.hpp"
#include "engine/records/fields.hpp"

namespace nezumi {

/// The table of a robot file with these changes. Tables with names are merged. Lists, positions, and sensors or
/// actuators of another kind are replaced as a whole; `false` removes a field. If `false` is given for a sensor,
/// actuator or port that does not exist, this is an error, which names the nearest. `path` is the path of the changes.
Value merge_values(FieldCheck& check, const Value& base, const Value& changes, const FieldPath& path = {});

/// Combines two changes into one. If the second one removes a field, the combined change removes it too.
Value combine_changes(const Value& first, const Value& second);

}  // namespace nezumi
