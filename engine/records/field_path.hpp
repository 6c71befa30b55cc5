// Where a field is: in nested tables, and in the text of a file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

class Value;

/// A path to a field in nested tables: "pose", "x"; elements are "[1]", "[2]".
using FieldPath = std::vector<std::string>;

/// "pose.x", "sensors.front.at[2]".
std::string to_text(const FieldPath& path);

/// The arguments of a call such as `robot "mouse" { ... }`: the name ("" if there is none or it is unknown), and the
/// table or null.
struct GivenTable {
    std::string name{};
    const Value* table = nullptr;
};

/// Finds where a file's text has the fields of a call's table. The part of the program that reads Lua implements it.
class FieldSource {
public:
    virtual ~FieldSource() = default;
    /// The location of a field in the table argument of the function `word`, which is called at `call`. If the text
    /// does not contain the field (because a program made it), the location of the outer field; if that is missing too,
    /// `call`. If the line has several calls, uses the one whose text fits `given`; if several fit, returns `call`.
    virtual Place find(std::string_view word, const Place& call, const FieldPath& path,
                       const GivenTable& given) const = 0;

protected:
    FieldSource() = default;
    FieldSource(const FieldSource&) = default;
    FieldSource(FieldSource&&) = default;
    FieldSource& operator=(const FieldSource&) = default;
    FieldSource& operator=(FieldSource&&) = default;
};

}  // namespace nezumi
