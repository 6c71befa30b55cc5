// Puts the fields of one table over those of another: how a robot differs from the one that it builds on.
#pragma once

#include "bindings/lua/files/file_fields.hpp"
#include "bindings/lua/files/file_value.hpp"

namespace nezumi {

/// The table of a robot file with these changes. Tables with names merge; lists, places and things that change their
/// kind are replaced whole; `false` takes a field away. A sensor, actuator or port that `false` would take away and
/// that is not there is an error, which names the nearest. `path` is where the changes stand.
Value merge_values(FieldCheck& check, const Value& base, const Value& changes, const FieldPath& path = {});

/// Two changes, one after the other, as one: what the second takes away it still takes away.
Value combine_changes(const Value& first, const Value& second);

}  // namespace nezumi
