// Finds the calls that write a structure field by field.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/syntax/syntax_tree.hpp"
#include "bindings/lua/syntax/text_edits.hpp"

namespace nezumi {

/// `port:write { a = x, b = y }`.
struct FieldWrite {
    std::string port;                 ///< the name of the out-port
    std::vector<std::string> fields;  ///< in order of the text
    bool operator==(const FieldWrite&) const = default;
};

/// Edits such calls so that they make no table: `port:write_1(x, y)`, with the number of the `FieldWrite` from 1.
/// Returns all of them.
std::vector<FieldWrite> edit_field_writes(const SyntaxTree& tree, TextEdits& edits);

/// The name of the method that such a call calls.
std::string method_of_field_write(std::size_t number);

}  // namespace nezumi
