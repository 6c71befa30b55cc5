// Finds the messages that a behaviour uses only where it reads them.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/syntax/syntax_tree.hpp"

namespace nezumi {

/// Names of the in-ports whose messages can't be seen any more after the call of the behaviour that read them, because
/// the text only takes fields, elements or the length of them: `p:read().x`, `p:read()[i]`, `#p:read()`,
/// `table.unpack(p:read())`, `for i, x in ipairs(p:read()) do`, and the same with a local variable of that function.
/// Such a port may give its messages in the same table each time.
std::vector<std::string> ports_read_in_place(const SyntaxTree& tree);

}  // namespace nezumi
