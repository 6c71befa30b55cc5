// Looks only at statements of the outermost block.
#include "bindings/lua/syntax/declared_ports.hpp"

namespace nezumi {

using Kind = SyntaxNode::Kind;

LocalUses uses_of_locals(const SyntaxTree& tree) {
    LocalUses uses;
    for (const SyntaxNode& node : tree.nodes()) {
        if (node.is(Kind::name) && node.variable != nullptr) uses[node.variable].push_back(&node);
    }
    return uses;
}

const LocalName* variable_of(const SyntaxNode& local, const SyntaxNode& expression) {
    const SyntaxNode* declared = local.at(0)->child;
    for (const SyntaxNode& value : *local.at(1)) {
        if (declared == nullptr || &value == &expression) break;
        declared = declared->next;
    }
    return declared != nullptr ? declared->variable : nullptr;
}

std::vector<DeclaredPort> declared_ports(const SyntaxTree& tree, const LocalUses& uses) {
    std::vector<DeclaredPort> ports;
    for (const SyntaxNode& statement : tree.root()) {
        if (!statement.is(Kind::local) || statement.at(1) == nullptr) continue;
        for (const SyntaxNode& value : *statement.at(1)) {
            if (!value.is(Kind::call) || value.at(1)->child == nullptr) continue;
            const SyntaxNode& first = *value.at(1)->child;
            const auto name = first.string();
            const auto type = first.next != nullptr ? first.next->string() : std::nullopt;
            const auto of = uses.find(variable_of(statement, value));
            if (!name || of == uses.end()) continue;
            for (const std::string_view function : {"input", "output"}) {
                if (value.child->is_global(function)) ports.push_back({function, *name, type.value_or(""), of->second});
            }
        }
    }
    return ports;
}

}  // namespace nezumi
