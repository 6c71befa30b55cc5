// Expressions, with the priorities of Lua's operators.
#include <algorithm>
#include <utility>

#include "bindings/lua/syntax/parser.hpp"

namespace nezumi {
namespace {

struct Priority {
    int left = 0;
    int right = 0;
};

constexpr int unary_priority = 12;

// The priority of a binary operator; 0 for any other token.
Priority priority_of(const Token& token) {
    static constexpr std::pair<std::string_view, Priority> operators[] = {
        {"+", {10, 10}},  {"-", {10, 10}}, {"*", {11, 11}}, {"%", {11, 11}}, {"^", {14, 13}}, {"/", {11, 11}},
        {"//", {11, 11}}, {"&", {6, 6}},   {"|", {4, 4}},   {"~", {5, 5}},   {"<<", {7, 7}},  {">>", {7, 7}},
        {"..", {9, 8}},   {"==", {3, 3}},  {"<", {3, 3}},   {"<=", {3, 3}},  {"~=", {3, 3}},  {">", {3, 3}},
        {">=", {3, 3}},   {"and", {2, 2}}, {"or", {1, 1}}};
    if (token.kind != Token::Kind::sign && token.kind != Token::Kind::keyword) return {};
    const auto* const found = std::find_if(std::begin(operators), std::end(operators),
                                           [&](const auto& each) { return each.first == token.text; });
    return found != std::end(operators) ? found->second : Priority{};
}

bool is_unary(const Token& token) { return token.is("not") || token.is("-") || token.is("#") || token.is("~"); }

}  // namespace

SyntaxNode* LuaParser::expressions() {
    SyntaxNode* const node = open(Kind::expressions);
    do adopt(node, expression());
    while (accept(","));
    return close(node);
}

SyntaxNode* LuaParser::expression(int limit) {
    const Level level(*this);
    SyntaxNode* left = nullptr;
    if (is_unary(*token_)) {
        left = open(Kind::unary);
        left->word = take();
        adopt(left, expression(unary_priority));
        close(left);
    } else {
        left = simple_expression();
    }
    for (Priority priority = priority_of(*token_); priority.left > limit; priority = priority_of(*token_)) {
        left = around(Kind::binary, left);
        left->word = take();
        adopt(left, expression(priority.right));
        close(left);
    }
    return left;
}

bool LuaParser::at_value() const {
    return token_->kind == Token::Kind::number || token_->kind == Token::Kind::string || at("nil") || at("true") ||
           at("false") || at("...");
}

SyntaxNode* LuaParser::simple_expression() {
    if (at("{")) return table();
    if (at("function")) return function(false);
    if (!at_value()) return suffixed_expression();
    if (at("...") && !scopes_.takes_more()) wrong();
    SyntaxNode* const node = open(Kind::literal);
    take();
    return close(node);
}

SyntaxNode* LuaParser::primary_expression() {
    if (at("(")) {
        SyntaxNode* const node = open(Kind::parenthesis);
        take();
        adopt(node, expression());
        expect(")");
        return close(node);
    }
    SyntaxNode* const node = open(Kind::name);
    node->word = name();
    if (node->word == nullptr) {
        node->kind = Kind::missing;
        return node;
    }
    resolve(node);
    return close(node);
}

SyntaxNode* LuaParser::suffixed_expression() {
    SyntaxNode* node = primary_expression();
    if (node->is(Kind::missing)) return node;
    for (;;) {
        if (at(".")) {
            node = around(Kind::member, node);
            take();
            node->word = member_name();
        } else if (at("[")) {
            node = around(Kind::subscript, node);
            take();
            adopt(node, expression());
            expect("]");
        } else if (at(":")) {
            node = around(Kind::method_call, node);
            take();
            node->word = member_name();
            adopt(node, arguments());
        } else if (at("(") || at("{") || token_->kind == Token::Kind::string) {
            node = around(Kind::call, node);
            adopt(node, arguments());
        } else {
            return node;
        }
        close(node);
    }
}

SyntaxNode* LuaParser::arguments() {
    SyntaxNode* const node = open(Kind::expressions);
    if (at("{") || token_->kind == Token::Kind::string) {
        adopt(node, simple_expression());
        return close(node);
    }
    expect("(");
    if (node->first == token_) return node;
    if (!at(")")) {
        do adopt(node, expression());
        while (accept(","));
    }
    expect(")");
    return close(node);
}

SyntaxNode* LuaParser::table() {
    SyntaxNode* const node = open(Kind::table);
    take();
    while (!at("}")) {
        adopt(node, table_entry());
        if (!accept(",") && !accept(";")) break;
    }
    expect("}");
    return close(node);
}

SyntaxNode* LuaParser::table_entry() {
    SyntaxNode* const node = open(Kind::element);
    if (accept("[")) {
        node->kind = Kind::keyed_field;
        adopt(node, expression());
        expect("]");
        expect("=");
    } else if (token_->kind == Token::Kind::name && token_[1].is("=")) {
        node->kind = Kind::field;
        node->word = take();
        take();
    }
    adopt(node, expression());
    return close(node);
}

SyntaxNode* LuaParser::function(bool is_method) {
    const Token* const begin = token_;
    SyntaxNode* const node = open(Kind::function);
    accept("function");
    SyntaxNode* const parameters = open(Kind::declarations);
    adopt(node, parameters);
    expect("(");
    bool takes_more = false;
    while (!at(")") && !at_end()) {
        takes_more = accept("...");
        if (takes_more) break;
        SyntaxNode* const parameter = open(Kind::declaration);
        parameter->word = name();
        adopt(parameters, close(parameter));
        if (!accept(",")) break;
        if (at(")")) wrong();
    }
    expect(")");
    close(parameters);
    scopes_.open_function(takes_more);
    if (is_method) scopes_.declare("self", begin, token_, false);
    for (SyntaxNode* each = parameters->child; each != nullptr; each = each->next) {
        if (each->word != nullptr) declare(each);
    }
    SyntaxNode* const body = open(Kind::block);
    adopt(node, body);
    statements(body);
    close(body);
    scopes_.close_function(token_);
    expect("end");
    return close(node);
}

}  // namespace nezumi
