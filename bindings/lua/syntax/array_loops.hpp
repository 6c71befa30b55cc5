// Finds the loops over arrays of which nothing is used any more after the loop.
#pragma once

#include <string_view>
#include <vector>

#include "bindings/lua/syntax/syntax_tree.hpp"
#include "bindings/lua/syntax/text_edits.hpp"

namespace nezumi {

/// The variable of an array in an edited loop.
inline constexpr std::string_view hidden_array = "hidden_array_";

/// Whether a variable of a running function is not one of its text: Lua's own, or an array of an edited loop.
constexpr bool is_hidden(std::string_view variable) {
    return variable.empty() || variable.front() == '(' || variable == hidden_array;
}

/// Edits loops over arrays that are read in place (`ports_read_in_place`) so that they call no function for each
/// element: `for i, x in ipairs(p:read()) do ... end` becomes `do local hidden_array_ = p:read() for i = 1,
/// #hidden_array_ do local x = hidden_array_[i] ... end end`. A text that has a name `hidden_array_` stays. Returns the
/// lines of edited loops with further lines: each turn begins with two line events there, because it jumps back to this
/// line.
std::vector<int> edit_array_loops(const SyntaxTree& tree, TextEdits& edits);

}  // namespace nezumi
