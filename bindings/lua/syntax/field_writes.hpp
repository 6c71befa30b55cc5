// Finds the calls that write a structure field by field.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/syntax/syntax_tree.hpp"

namespace nezumi {

/// `port:write { a = x, b = y }`.
struct FieldWrite {
    std::string port;                 ///< the name of the out-port
    std::vector<std::string> fields;  ///< in order of the text
    bool operator==(const FieldWrite&) const = default;
};

/// A text in which such calls make no table: `port:write_1(x, y)`, with the number of its `FieldWrite` from 1. All
/// lines keep their numbers. Without such calls the text is empty.
struct FieldWrites {
    std::string text;
    std::vector<FieldWrite> writes;
};
FieldWrites with_field_writes(const SyntaxTree& tree);

/// The name of the method that such a call calls.
std::string method_of_field_write(std::size_t number);

}  // namespace nezumi
