// Reads single values of .msg and .idl files: constants and defaults.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/values/value.hpp"

namespace nezumi {

/// A boolean, a number or a text for a field of this kind ("boolean", "double", ...). Numbers may be hexadecimal;
/// texts may be quoted.
Expected<Value> plain_value(std::string_view text, std::string_view kind);

/// Splits a field's comment into unit and meaning: "[m/s] forward". The unit is "" if the comment has none.
struct FieldComment {
    std::string unit, doc;
};
FieldComment parse_comment(std::string_view comment);

}  // namespace nezumi
