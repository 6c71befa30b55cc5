// Puts the fields of one table over those of another: how a robot differs from the one that it builds on.
#pragma once

#include "bindings/lua/files/file_fields.hpp"
#include "bindings/lua/files/file_value.hpp"

namespace nezumi {

/// The table of a robot file with these changes. Tables with names merge; lists, places and things that change their
/// kind are replaced whole; `false` takes a field away. A sensor, actuator or port that `false` would take away and
/// that is not there is an error, which names the nearest. `path` is where the changes stand.
FileValue merge_values(FieldCheck& check, const FileValue& base, const FileValue& changes, const FieldPath& path = {});

/// Two changes, one after the other, as one: what the second takes away it still takes away.
FileValue combine_changes(const FileValue& first, const FileValue& second);

}  // namespace nezumi
