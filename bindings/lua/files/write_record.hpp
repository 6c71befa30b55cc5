// Writes a structure that describes itself as the table that a person would write.
#pragma once

#include <string>

#include "engine/ports/setting.hpp"

namespace nezumi {

/// A field's value as a file writes it, so that it reads back as the same.
std::string setting_text(const ValueView& value, const Rule& rule = {});

/// The fields in which `value` differs from `from`, and those that are required: what a reader who begins with `from`
/// needs. Fields that are read by hand are left out. "{}" when there is nothing to say.
std::string write_record(const ValueView& value, const ValueView& from);
/// The same, from what the structure is by itself.
template <Recorded T>
std::string write_record(const T& value) {
    return write_record({record_of<T>(), &value}, Value(record_of<T>()));
}

}  // namespace nezumi
