// Explains syntax of other languages at the location of a syntax error.
#pragma once

#include <string_view>

#include "bindings/lua/syntax/syntax_tree.hpp"

namespace nezumi {

/// The hint for the syntax error of a text: "it is ~= in Lua" if the text has `!=` there. "" if there is no hint.
std::string_view other_language_hint(const SyntaxTree& tree);

}  // namespace nezumi
