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

/// The arguments of a call: the name before its table ("" if there is none or it is unknown), and the table or null.
struct GivenTable {
    std::string name{};
    const Value* table = nullptr;
};

/// Finds the fields of a call's table in the text of its file. The room that reads the language implements it.
class FieldSource {
public:
    virtual ~FieldSource() = default;
    /// The location of a field of the table argument of `word`, called at `call`. If the text does not contain the
    /// field (because a program made it), the location of the outer field; if it contains none, `call`. Of several
    /// calls in the line, the only one whose text fits `given`; `call` if this is ambiguous.
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
