// Checks values against the limits of fields that files define.
#pragma once

#include <string>

#include "engine/values/view.hpp"

namespace nezumi {

/// Checks a value against the limits of its field. Returns the error, such as "expected a number from 0 to 5, got 7",
/// or "".
std::string explain_misfit(const FieldLimits& limits, const ValueView& value);
/// Whether a value is within the limits of its field.
bool fits(const FieldLimits& limits, const ValueView& value);
/// Checks all fields of a value. Returns the first error, such as "field 'size.x' expected a number from 0 on, got -1",
/// or "".
std::string find_misfit(const ValueView& value);

}  // namespace nezumi
