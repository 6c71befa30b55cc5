// Writes a described structure as a table.
#pragma once

#include <string>

#include "engine/ports/setting.hpp"

namespace nezumi {

/// The value of a field in Lua syntax, which gives the same value when it is read.
std::string setting_text(const ValueView& value, const Rule& rule = {});

/// The fields of `value` that differ from `from`, and the required fields: a reader that begins with `from` then has
/// `value`. Omits fields that are read by special code (`Rule::by_hand`). "{}" if there are no fields.
std::string write_record(const ValueView& value, const ValueView& from);
/// The fields of `value` that differ from the defaults of the structure, and the required fields.
template <Recorded T>
std::string write_record(const T& value) {
    return write_record({record_of<T>(), &value}, Value(record_of<T>()));
}

}  // namespace nezumi
