// Only the tokens of the table are edited: its brackets, names and separators.
#include "bindings/lua/syntax/field_writes.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include "bindings/lua/syntax/declared_ports.hpp"

namespace nezumi {
namespace {

using Kind = SyntaxNode::Kind;

constexpr std::size_t most_fields = 16;  // each value needs a register of Lua

// The table of `port:write { a = x, b = y }`, of which `use` is the port; null for another call.
const SyntaxNode* table_of(const SyntaxNode& use) {
    const SyntaxNode& call = *use.parent;
    if (!call.is(Kind::method_call) || call.child != &use || call.word_text() != "write") return nullptr;
    const SyntaxNode& arguments = *call.at(1);
    if (arguments.count() != 1 || !arguments.child->is(Kind::table)) return nullptr;
    std::set<std::string_view> names;
    for (const SyntaxNode& field : *arguments.child) {
        if (!field.is(Kind::field) || !names.insert(field.word_text()).second) return nullptr;
    }
    return !names.empty() && names.size() <= most_fields ? arguments.child : nullptr;
}

void edit_call(const SyntaxNode& call, const SyntaxNode& table, std::size_t number, TextEdits& edits) {
    edits.replace(*call.word, method_of_field_write(number));
    const bool has_brackets = table.parent->first != table.first;
    edits.replace(*table.first, has_brackets ? "" : "(");
    for (const SyntaxNode& field : table) {
        edits.remove(field.first, field.first + 2);  // the name, and the sign `=`
        const bool is_last = field.next == nullptr;
        if (is_last) {
            // Brackets, because the last argument of a call may be several values. The call ends in the line of this
            // field, which would else have no instruction.
            edits.insert_before(*field.child->first, "(");
            edits.insert_after(field.end[-1], "))");
        }
        if (field.end != table.end - 1) edits.replace(*field.end, is_last ? "" : ",");
    }
    edits.remove(table.end - 1, table.parent->end);
}

}  // namespace

std::vector<FieldWrite> edit_field_writes(const SyntaxTree& tree, TextEdits& edits) {
    std::vector<FieldWrite> writes;
    for (const DeclaredPort& port : declared_ports(tree, uses_of_locals(tree))) {
        const bool is_constant =
            std::none_of(port.uses.begin(), port.uses.end(), [](const SyntaxNode* use) { return is_assigned(*use); });
        if (port.function != "output" || !is_constant) continue;
        for (const SyntaxNode* const use : port.uses) {
            const SyntaxNode* const table = table_of(*use);
            if (table == nullptr) continue;
            FieldWrite write{std::string(port.name), {}};
            for (const SyntaxNode& field : *table) write.fields.emplace_back(field.word_text());
            const auto same = std::find(writes.begin(), writes.end(), write);
            edit_call(*use->parent, *table, static_cast<std::size_t>(same - writes.begin()) + 1, edits);
            if (same == writes.end()) writes.push_back(std::move(write));
        }
    }
    return writes;
}

std::string method_of_field_write(std::size_t number) { return "write_" + std::to_string(number); }

}  // namespace nezumi
