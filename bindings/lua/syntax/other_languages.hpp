// What somebody who knows another language means where Lua finds a mistake of syntax.
#pragma once

#include <string_view>

#include "bindings/lua/syntax/syntax_tree.hpp"

namespace nezumi {

/// "it is ~= in Lua" for a text with `!=`: what to write where the text is refused. "" when that is not known.
std::string_view other_language_hint(const SyntaxTree& tree);

}  // namespace nezumi
