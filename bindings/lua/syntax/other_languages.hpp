// Explains syntax of other languages at the location of a syntax error.
#pragma once

#include <string_view>

#include "bindings/lua/syntax/syntax_tree.hpp"

namespace nezumi {

/// The hint for a syntax error: "it is ~= in Lua" for a text with `!=`. "" if there is none.
std::string_view other_language_hint(const SyntaxTree& tree);

}  // namespace nezumi
