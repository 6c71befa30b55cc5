// Questions about a single node.
#include "bindings/lua/syntax/syntax_tree.hpp"

#include <algorithm>

#include "bindings/lua/syntax/parser.hpp"

namespace nezumi {

std::string_view SyntaxNode::text() const {
    if (first == end) return first->text.substr(0, 0);
    const std::string_view last_text = end[-1].text;
    return {first->text.data(), static_cast<std::size_t>(last_text.data() + last_text.size() - first->text.data())};
}

const SyntaxNode* SyntaxNode::at(std::size_t index) const {
    const SyntaxNode* node = child;
    for (; node != nullptr && index > 0; --index) node = node->next;
    return node;
}

std::size_t SyntaxNode::count() const {
    return static_cast<std::size_t>(std::distance(begin(*this), nezumi::end(*this)));
}

std::optional<std::string_view> SyntaxNode::string() const {
    if (kind != Kind::literal || first->kind != Token::Kind::string) return std::nullopt;
    return first->inside();
}

bool SyntaxNode::is_global(std::string_view name) const {
    return kind == Kind::name && variable == nullptr && word->text == name;
}

const SyntaxNode& SyntaxNode::operand_of() const {
    const SyntaxNode* node = this;
    while (node->parent != nullptr &&
           (node->parent->is(Kind::binary) || node->parent->is(Kind::unary) || node->parent->is(Kind::parenthesis))) {
        node = node->parent;
    }
    return *node;
}

SyntaxTree::SyntaxTree(std::string_view source, Dialect dialect) : source_(source) {
    Lexer lexer(source);
    bool open_comment = false;
    do {
        const Token token = lexer.next();
        if (token.kind == Token::Kind::comment) {
            open_comment = token.open;
            ends_in_comment_ = token.open || (!token.is_long() && token.text.end() == source.end());
        } else {
            tokens_.push_back(token);
        }
    } while (tokens_.empty() || tokens_.back().kind != Token::Kind::end);
    if (open_comment) tokens_.back().open = true;
    LuaParser(*this, dialect).read();
}

bool SyntaxTree::ends_early() const { return error_ != nullptr && (error_->kind == Token::Kind::end || error_->open); }

std::optional<std::vector<std::string>> name_chain(const SyntaxNode& expression) {
    using Kind = SyntaxNode::Kind;
    std::vector<std::string> chain;
    const SyntaxNode* node = &expression;
    for (; node->is(Kind::member) || node->is(Kind::subscript); node = node->child) {
        const auto part = node->is(Kind::member) ? std::optional(node->word_text()) : node->last->string();
        if (!part || part->empty()) return std::nullopt;
        chain.emplace_back(*part);
    }
    if (!node->is(Kind::name)) return std::nullopt;
    chain.emplace_back(node->word->text);
    std::reverse(chain.begin(), chain.end());
    return chain;
}

std::optional<FieldName> field_of(const SyntaxNode& expression) {
    const SyntaxNode* const parent = expression.parent;
    if (parent == nullptr || parent->child != &expression) return std::nullopt;
    if (parent->is(SyntaxNode::Kind::member) && parent->word != nullptr)
        return FieldName{parent->word->text, parent->word};
    const auto text = parent->is(SyntaxNode::Kind::subscript) ? parent->last->string() : std::nullopt;
    if (!text || text->find('\\') != std::string_view::npos) return std::nullopt;
    return FieldName{*text, parent->last->first};
}

bool is_assigned(const SyntaxNode& expression) {
    using Kind = SyntaxNode::Kind;
    const SyntaxNode* const parent = expression.parent;
    if (parent == nullptr) return false;
    if (parent->is(Kind::function_statement)) return parent->child == &expression;
    return parent->is(Kind::expressions) && parent->parent != nullptr && parent->parent->is(Kind::assignment) &&
           parent->parent->child == parent;
}

}  // namespace nezumi
