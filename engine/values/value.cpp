// Compares values.
#include "engine/values/value.hpp"

#include "engine/values/walk.hpp"

namespace nezumi {

bool Value::operator==(const Value& other) const { return is_equal(*this, other); }

}  // namespace nezumi
