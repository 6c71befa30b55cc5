// A tail call is a `return` of a single call without brackets around it.
#include "bindings/lua/syntax/tail_calls.hpp"

#include <algorithm>

#include "bindings/lua/syntax/syntax_tree.hpp"

namespace nezumi {

std::vector<int> tail_calls_of(std::string_view text, int first, int last) {
    using Kind = SyntaxNode::Kind;
    std::vector<int> lines;
    const SyntaxTree tree(without_preamble(text));
    for (const SyntaxNode& node : tree.nodes()) {
        if (!node.is(Kind::return_statement) || node.child == nullptr) continue;
        const SyntaxNode& values = *node.child;
        const SyntaxNode* value = values.is(Kind::expressions) ? values.child : &values;
        if (value == nullptr || value->next != nullptr || !(value->is(Kind::call) || value->is(Kind::method_call)))
            continue;
        const SyntaxNode* function = node.parent;
        while (function != nullptr && !function->is(Kind::function)) function = function->parent;
        if (function == nullptr) continue;
        const SyntaxNode& whole = function->parent != nullptr && (function->parent->is(Kind::function_statement) ||
                                                                  function->parent->is(Kind::local_function))
                                      ? *function->parent
                                      : *function;
        if (whole.first->line == first && (whole.end - 1)->line == last) lines.push_back(value->first->line);
    }
    std::sort(lines.begin(), lines.end());
    return lines;
}

}  // namespace nezumi
