// The ports of a behaviour that are variables of its file.
#pragma once

#include <map>
#include <string_view>
#include <vector>

#include "bindings/lua/syntax/syntax_tree.hpp"

namespace nezumi {

/// The names in a text that mean each local variable, in order of location.
using LocalUses = std::map<const LocalName*, std::vector<const SyntaxNode*>>;
LocalUses uses_of_locals(const SyntaxTree& tree);

/// The variable of `local a, b = ...` that gets this expression; null: none.
const LocalName* variable_of(const SyntaxNode& local, const SyntaxNode& expression);

/// `local p = input("name", ...)`, or with `output`, at the top of a text. There, the statement runs once, and another
/// declaration of the same port is refused.
struct DeclaredPort {
    std::string_view function;  ///< "input", "output"
    std::string_view name;
    std::string_view type;                  ///< "" if it is not given as a string
    std::vector<const SyntaxNode*> uses{};  ///< of the variable
};
std::vector<DeclaredPort> declared_ports(const SyntaxTree& tree, const LocalUses& uses);

}  // namespace nezumi
