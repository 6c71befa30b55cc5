// Searches from the last token outwards.
#include "bindings/console/cursor_text.hpp"

#include <utility>

namespace nezumi {
namespace {

using Kind = SyntaxNode::Kind;

// The name of the field in an entry of a table; "" for an entry without a name.
std::string given_field(const SyntaxNode& entry) {
    if (entry.is(Kind::field)) return std::string(entry.word_text());
    return entry.is(Kind::keyed_field) ? std::string(entry.child->string().value_or("")) : "";
}

}  // namespace

CursorText::CursorText(std::string_view text) : tree_(text, SyntaxTree::Dialect::console) {
    const Token* const begin = tree_.tokens().data();
    const Token* here = &tree_.tokens().back();
    if (here != begin) last_ = here - 1;
    if (last_ != nullptr && last_->is_word() && touches_cursor(*last_)) here = part_ = last_;
    if (here != begin && (here[-1].is(".") || here[-1].is(":"))) separator_ = here - 1;
    for (const SyntaxNode& node : tree_.nodes()) {
        const bool is_literal = node.is(Kind::literal) && node.first->open;
        if (is_literal) quoted_ = &node;
        if (node_ != nullptr) continue;
        const bool has_member = node.is(Kind::member) || node.is(Kind::method_call);
        const bool is_it = separator_ != nullptr
                               ? has_member && node.child->end == separator_
                               : (node.is(Kind::name) || node.is(Kind::missing)) && node.first == here;
        if (is_it) node_ = &node;
    }
}

bool CursorText::touches_cursor(const Token& token) const {
    return token.text.data() + token.text.size() == tree_.source().data() + tree_.source().size();
}

// The names before the separator of a member; without a separator, only the part at the cursor.
NameAtCursor CursorText::named(const SyntaxNode& node, const Token* separator) const {
    NameAtCursor result;
    if (separator == nullptr) return result;
    result.separator = separator->text.front();
    auto chain = name_chain(*node.child);
    result.broken = !chain;
    if (chain) result.chain = std::move(*chain);
    return result;
}

NameAtCursor CursorText::name() const {
    const bool is_literal =
        last_ != nullptr && (last_->kind == Token::Kind::number || last_->kind == Token::Kind::string);
    NameAtCursor result;
    if (separator_ != nullptr && node_ != nullptr) {
        result = named(*node_, separator_);
    } else if (separator_ != nullptr || (is_literal && touches_cursor(*last_))) {  // "3." is a number
        result.separator = '.';
        result.broken = true;
    }
    result.from = part_ != nullptr ? tree_.offset(*part_) : tree_.source().size();
    return result;
}

// Finds the call that has the value, or an operation on the value, as an argument.
void CursorText::find_call(TextAtCursor& result, const SyntaxNode& value) const {
    const SyntaxNode& argument = value.operand_of();
    const SyntaxNode* const given = argument.parent;
    const bool is_given = given != nullptr && given->is(Kind::expressions) && given->parent != nullptr &&
                          (given->parent->is(Kind::call) || given->parent->is(Kind::method_call));
    if (!is_given) return;
    const SyntaxNode* call = given->parent;
    const SyntaxNode* first = given->child;
    for (const SyntaxNode* each = first; each != &argument; each = each->next) ++result.argument;
    if (call->child->is(Kind::call) && call->child->last->child != nullptr) {  // `robot "mouse" { ... }`
        call = call->child;
        first = call->last->child;
        ++result.argument;
    }
    if (first != &argument) {
        result.first = first->string().value_or("");
        result.first_chain = name_chain(*first).value_or(std::vector<std::string>());
    }
    const SyntaxNode& named_by = call->is(Kind::method_call) ? *call : *call->child;
    const bool is_named = named_by.is(Kind::name) || named_by.is(Kind::member) || named_by.is(Kind::method_call);
    if (!is_named || named_by.word == nullptr) return;
    result.callee = named(named_by, named_by.is(Kind::name) ? nullptr : named_by.child->end);
    result.word = named_by.word->text;
}

TextAtCursor CursorText::quoted() const {
    TextAtCursor result;
    if (last_ == nullptr || !last_->open) return result;
    result.open = true;
    result.from = tree_.source().size() - last_->inside().size();
    if (quoted_ == nullptr) return result;
    const SyntaxNode* value = &quoted_->operand_of();
    if (value->parent != nullptr) result.field = given_field(*value->parent);
    if (!result.field.empty()) value = value->parent->parent;
    find_call(result, *value);
    return result;
}

TextAtCursor CursorText::call() const {
    TextAtCursor result;
    if (node_ != nullptr) find_call(result, *node_);
    return result;
}

FieldAtCursor CursorText::field() const {
    FieldAtCursor result;
    const bool is_element =
        separator_ == nullptr && node_ != nullptr && node_->parent != nullptr && node_->parent->is(Kind::element);
    if (!is_element) return result;
    const SyntaxNode* table = node_->parent->parent;
    for (; table->parent->is(Kind::field) || table->parent->is(Kind::keyed_field); table = table->parent->parent) {
        std::string name = given_field(*table->parent);
        if (name.empty() || table->parent->last != table) return result;
        result.path.insert(result.path.begin(), std::move(name));
    }
    find_call(result.call, *table);
    result.open = !result.call.word.empty();
    return result;
}

}  // namespace nezumi
