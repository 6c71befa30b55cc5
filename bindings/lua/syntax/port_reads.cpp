// A message may be used later if it, or a variable that has it, is used in any way that is not listed here.
#include "bindings/lua/syntax/port_reads.hpp"

#include <algorithm>

#include "bindings/lua/syntax/declared_ports.hpp"

namespace nezumi {
namespace {

using Kind = SyntaxNode::Kind;

const SyntaxNode* function_around(const SyntaxNode& node) {
    const SyntaxNode* outer = node.parent;
    while (outer != nullptr && !outer->is(Kind::function)) outer = outer->parent;
    return outer;
}

const SyntaxNode& with_parentheses(const SyntaxNode& expression) {
    const SyntaxNode* outer = &expression;
    while (outer->parent->is(Kind::parenthesis)) outer = outer->parent;
    return *outer;
}

bool is_unpacking(const SyntaxNode& called) {
    return called.is(Kind::member) && called.child->is_global("table") && called.word_text() == "unpack";
}

// Whether an expression takes elements or fields of `value`, a message, or its length, and drops it. `ipairs(value)`
// returns the message, so only a loop drops it.
bool is_dropped(const SyntaxNode& value) {
    const SyntaxNode& whole = with_parentheses(value);
    const SyntaxNode& parent = *whole.parent;
    if (parent.is(Kind::subscript) || parent.is(Kind::member)) return parent.child == &whole && !is_assigned(parent);
    if (parent.is(Kind::unary)) return parent.word_text() == "#";
    if (!parent.is(Kind::expressions) || !parent.parent->is(Kind::call) || parent.child != &whole) return false;
    const SyntaxNode& call = *parent.parent;
    if (is_unpacking(*call.child)) return true;
    return call.child->is_global("ipairs") && call.parent->is(Kind::expressions) &&
           call.parent->parent->is(Kind::for_loop);
}

bool is_used_in_place(const SyntaxNode& value, const LocalUses& uses) {
    if (is_dropped(value)) return true;
    const SyntaxNode& whole = with_parentheses(value);
    const SyntaxNode& owner = *whole.parent->parent;
    if (!whole.parent->is(Kind::expressions) || !owner.is(Kind::local)) return false;
    const auto of = uses.find(variable_of(owner, whole));
    return of == uses.end() || std::all_of(of->second.begin(), of->second.end(), [&](const SyntaxNode* use) {
               return function_around(*use) == function_around(owner) && is_dropped(*use);
           });
}

bool is_read_in_place(const SyntaxNode& port, const LocalUses& uses) {
    const SyntaxNode& parent = *port.parent;
    if (parent.is(Kind::member)) return parent.word_text() != "read" && !is_assigned(parent);
    return parent.is(Kind::method_call) && parent.child == &port && is_used_in_place(parent, uses);
}

}  // namespace

std::vector<std::string> ports_read_in_place(const SyntaxTree& tree) {
    const LocalUses uses = uses_of_locals(tree);
    std::vector<std::string> names;
    for (const DeclaredPort& port : declared_ports(tree, uses)) {
        if (port.function == "input" && std::all_of(port.uses.begin(), port.uses.end(), [&](const SyntaxNode* use) {
                return is_read_in_place(*use, uses);
            }))
            names.emplace_back(port.name);
    }
    return names;
}

}  // namespace nezumi
