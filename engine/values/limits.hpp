// Whether values keep to the limits of the fields that a file defines.
#pragma once

#include <string>

#include "engine/values/view.hpp"

namespace nezumi {

/// What is wrong with a value by the limits of its field, as "expected a number from 0 to 5, got 7"; "" for nothing.
std::string explain_misfit(const FieldLimits& limits, const ValueView& value);
/// Whether nothing is.
bool fits(const FieldLimits& limits, const ValueView& value);
/// What is wrong with the first field of a value that its limits refuse: "field 'size.x' expected a number from 0 on,
/// got -1"; "" for nothing.
std::string find_misfit(const ValueView& value);

}  // namespace nezumi
