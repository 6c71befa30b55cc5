// A message that is a sequence has all elements from 1 to its length, so `ipairs` visits the same ones.
#include "bindings/lua/syntax/array_loops.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "bindings/lua/syntax/declared_ports.hpp"
#include "bindings/lua/syntax/port_reads.hpp"
#include "engine/base/list.hpp"
#include "engine/ports/port_base.hpp"

namespace nezumi {
namespace {

using Kind = SyntaxNode::Kind;

bool is_of_arrays(const DeclaredPort& port) {
    const auto type = find_message_type(port.type);
    return type && (*type)->payload->kind == Type::Kind::sequence;
}

class LoopEditor {
public:
    LoopEditor(const SyntaxTree& tree, TextEdits& edits) : tree_(tree), edits_(edits) {
        const LocalUses uses = uses_of_locals(tree);
        const std::vector<std::string> in_place = ports_read_in_place(tree);
        for (const DeclaredPort& port : declared_ports(tree, uses)) {
            if (port.function != "input" || !contains(in_place, port.name) || !is_of_arrays(port)) continue;
            for (const SyntaxNode* const use : port.uses) add_read(*use->parent);
        }
    }

    std::vector<int> operator()() {
        for (const SyntaxNode& node : tree_.nodes()) {
            if (node.is(Kind::for_loop) && node.child->end->is("in")) edit(node);
        }
        return std::move(doubled_);
    }

private:
    // A message, or a variable that gets one.
    void add_read(const SyntaxNode& read) {
        if (!read.is(Kind::method_call) || read.at(1)->child != nullptr) return;
        reads_.insert(&read);
        if (!read.parent->is(Kind::expressions) || !read.parent->parent->is(Kind::local)) return;
        if (const LocalName* const variable = variable_of(*read.parent->parent, read)) variables_.insert(variable);
    }

    void edit(const SyntaxNode& loop) {
        const SyntaxNode& names = *loop.at(0);
        const SyntaxNode& values = *loop.at(1);
        const SyntaxNode& call = *values.child;
        if (names.count() > 2 || values.count() != 1 || !call.is(Kind::call) || !call.child->is_global("ipairs") ||
            call.at(1)->count() != 1)
            return;
        const SyntaxNode& array = *call.at(1)->child;
        const std::string_view index = names.child->word_text();
        const bool is_variable = array.is(Kind::name) && variables_.contains(array.variable);
        if (is_variable ? array.word_text() == index : !reads_.contains(&array)) return;
        // The message is read before the loop, in the line of the loop.
        if (loop.first->line != array.end[-1].line) return;
        const std::string text(is_variable ? array.word_text() : hidden_array);
        if (!is_variable)
            edits_.insert_before(*loop.first, "do local " + text + " = " + std::string(array.text()) + " ");
        edits_.remove(names.child->end, values.end);
        edits_.insert_after(*names.child->word, " = 1, #" + text);
        if (names.count() == 2) {
            edits_.insert_after(*values.end, " local " + std::string(names.last->word_text()) + " = " + text + "[" +
                                                 std::string(index) + "]");
        }
        if (!is_variable) edits_.insert_after(loop.end[-1], " end");
        if (loop.end[-2].line > loop.first->line) doubled_.push_back(loop.first->line);
    }

    const SyntaxTree& tree_;
    TextEdits& edits_;
    std::set<const SyntaxNode*> reads_{};
    std::set<const LocalName*> variables_{};
    std::vector<int> doubled_{};
};

}  // namespace

std::vector<int> edit_array_loops(const SyntaxTree& tree, TextEdits& edits) {
    const auto& tokens = tree.tokens();
    const bool is_taken =
        std::any_of(tokens.begin(), tokens.end(), [](const Token& each) { return each.text == hidden_array; });
    return is_taken ? std::vector<int>() : LoopEditor(tree, edits)();
}

}  // namespace nezumi
