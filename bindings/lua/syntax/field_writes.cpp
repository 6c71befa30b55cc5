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

struct Edit {
    std::size_t at;
    std::size_t size;
    std::string text;
};

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

class Writer {
public:
    explicit Writer(const SyntaxTree& tree) : tree_(tree) {}

    FieldWrites operator()() {
        for (const DeclaredPort& port : declared_ports(tree_, uses_of_locals(tree_))) {
            if (port.function != "output" || std::any_of(port.uses.begin(), port.uses.end(),
                                                         [](const SyntaxNode* use) { return is_assigned(*use); }))
                continue;
            for (const SyntaxNode* const use : port.uses) {
                if (const SyntaxNode* const table = table_of(*use)) rewrite(port, *use->parent, *table);
            }
        }
        if (!found_.writes.empty()) found_.text = edited();
        return std::move(found_);
    }

private:
    void edit(const Token& token, std::string text) {
        edits_.push_back({tree_.offset(token), token.text.size(), std::move(text)});
    }

    void rewrite(const DeclaredPort& port, const SyntaxNode& call, const SyntaxNode& table) {
        FieldWrite write{std::string(port.name), {}};
        for (const SyntaxNode& field : table) write.fields.emplace_back(field.word_text());
        auto& writes = found_.writes;
        const auto same = std::find(writes.begin(), writes.end(), write);
        const auto number = static_cast<std::size_t>(same - writes.begin()) + 1;
        if (same == writes.end()) writes.push_back(std::move(write));

        edit(*call.word, method_of_field_write(number));
        const bool has_brackets = table.parent->first != table.first;
        edit(*table.first, has_brackets ? "" : "(");
        for (const SyntaxNode& field : table) {
            edit(field.first[0], "");
            edit(field.first[1], "");  // the sign `=`
            const bool is_last = field.next == nullptr;
            if (is_last) {
                // Brackets, because the last argument of a call may be several values.
                edits_.push_back({tree_.offset(*field.child->first), 0, "("});
                const std::string_view end = field.end[-1].text;
                edits_.push_back({tree_.offset(field.end[-1]) + end.size(), 0, ")"});
            }
            if (field.end != table.end - 1) edit(*field.end, is_last ? "" : ",");
        }
        edit(table.end[-1], has_brackets ? "" : ")");
    }

    std::string edited() {
        std::stable_sort(edits_.begin(), edits_.end(), [](const Edit& a, const Edit& b) { return a.at < b.at; });
        std::string text;
        std::size_t done = 0;
        for (const Edit& each : edits_) {
            text += tree_.source().substr(done, each.at - done);
            text += each.text;
            done = each.at + each.size;
        }
        return text += tree_.source().substr(done);
    }

    const SyntaxTree& tree_;
    FieldWrites found_{};
    std::vector<Edit> edits_{};
};

}  // namespace

FieldWrites with_field_writes(const SyntaxTree& tree) { return Writer(tree)(); }

std::string method_of_field_write(std::size_t number) { return "write_" + std::to_string(number); }

}  // namespace nezumi
