// Nodes, names and statements, in the order of Lua's own parser (lparser.c of 5.4), so that both refuse the same texts.
#include "bindings/lua/syntax/parser.hpp"

#include <utility>
#include <vector>

namespace nezumi {

void LuaParser::read() {
    SyntaxNode* const root = open(Kind::block);
    scopes_.open_function(true);
    for (;;) {
        statements(root);
        if (at_end()) break;
        wrong();  // an `end` without a block
        take();
    }
    scopes_.close_function(token_);
    close(root);
    if (token_->open) wrong();  // within a comment
    for (const Token& token : tree_.tokens_) {
        if (token.open || token.malformed) wrong(&token);
    }
    if (scopes_.error() != nullptr) wrong(scopes_.error());
}

bool LuaParser::accept(std::string_view word) {
    if (!at(word)) return false;
    take();
    return true;
}

void LuaParser::expect(std::string_view word) {
    if (!accept(word)) wrong();
}

void LuaParser::wrong(const Token* token) {
    if (tree_.error_ == nullptr || token < tree_.error_) tree_.error_ = token;
}

SyntaxNode* LuaParser::open(Kind kind) {
    SyntaxNode* const node = &tree_.nodes_.emplace_back();
    node->kind = kind;
    node->first = node->end = token_;
    return node;
}

// A node that begins with a node that was already read.
SyntaxNode* LuaParser::around(Kind kind, SyntaxNode* first) {
    SyntaxNode* const node = open(kind);
    node->first = first->first;
    adopt(node, first);
    return node;
}

SyntaxNode* LuaParser::close(SyntaxNode* node) {
    node->end = token_;
    return node;
}

void LuaParser::adopt(SyntaxNode* parent, SyntaxNode* child) {
    child->parent = parent;
    (parent->last != nullptr ? parent->last->next : parent->child) = child;
    parent->last = child;
}

const Token* LuaParser::name() {
    if (token_->kind == Token::Kind::name) return take();
    wrong();
    return nullptr;
}

// Lua accepts no keyword here. If there is one, it is taken as a name.
const Token* LuaParser::member_name() {
    if (token_->kind != Token::Kind::keyword) return name();
    if (!keyword_members_) wrong();
    return take();
}

void LuaParser::resolve(SyntaxNode* name) { name->variable = scopes_.find(name->word->text); }

void LuaParser::declare(SyntaxNode* declaration, bool constant) {
    declaration->variable = scopes_.declare(declaration->word->text, declaration->word, token_, constant);
}

bool LuaParser::ends_block() const { return at_end() || at("end") || at("else") || at("elseif") || at("until"); }

SyntaxNode* LuaParser::block(bool is_loop) {
    SyntaxNode* const node = open(Kind::block);
    scopes_.open_block(is_loop);
    statements(node);
    scopes_.close_block(token_);
    return close(node);
}

void LuaParser::statements(SyntaxNode* block) {
    while (!ends_block()) {
        const Token* const before = token_;
        const bool is_last = at("return");
        if (SyntaxNode* const read = statement()) adopt(block, read);
        if (is_last && !ends_block()) wrong();
        if (token_ != before) continue;
        wrong();
        take();
    }
}

SyntaxNode* LuaParser::statement() {
    const Level level(*this);
    if (accept(";")) return nullptr;
    if (at("if")) return branches();
    if (at("while")) return while_loop();
    if (at("for")) return for_loop();
    if (at("repeat")) return repeat_loop();
    if (at("function")) return function_statement();
    if (at("local")) return local();
    if (at("::")) return label();
    if (at("return")) return return_statement();
    if (at("goto")) return goto_statement();
    if (at("break")) {
        SyntaxNode* const node = open(Kind::break_statement);
        scopes_.add_break(take());
        return close(node);
    }
    if (at("do")) {
        SyntaxNode* const node = open(Kind::do_block);
        take();
        adopt(node, block());
        expect("end");
        return close(node);
    }
    return expression_statement();
}

SyntaxNode* LuaParser::branches() {
    SyntaxNode* const node = open(Kind::branches);
    do {
        take();
        adopt(node, expression());
        expect("then");
        adopt(node, block());
    } while (at("elseif"));
    if (accept("else")) adopt(node, block());
    expect("end");
    return close(node);
}

SyntaxNode* LuaParser::while_loop() {
    SyntaxNode* const node = open(Kind::while_loop);
    take();
    adopt(node, expression());
    expect("do");
    adopt(node, block(true));
    expect("end");
    return close(node);
}

SyntaxNode* LuaParser::for_loop() {
    SyntaxNode* const node = open(Kind::for_loop);
    take();
    SyntaxNode* const names = open(Kind::declarations);
    adopt(node, names);
    do {
        SyntaxNode* const variable = open(Kind::declaration);
        variable->word = name();
        adopt(names, close(variable));
    } while (accept(","));
    close(names);
    const bool is_numeric = at("=");
    if (is_numeric && names->count() == 1) {
        take();
    } else {
        expect("in");
        if (is_numeric) take();
    }
    SyntaxNode* const values = expressions();
    adopt(node, values);
    if (is_numeric && (values->count() < 2 || values->count() > 3)) wrong();
    expect("do");
    scopes_.open_block(true);
    for (SyntaxNode* each = names->child; each != nullptr; each = each->next) {
        if (each->word != nullptr) declare(each);
    }
    adopt(node, block());
    scopes_.close_block(token_);
    expect("end");
    return close(node);
}

SyntaxNode* LuaParser::repeat_loop() {
    SyntaxNode* const node = open(Kind::repeat_loop);
    take();
    scopes_.open_block(true);
    scopes_.open_block(false);
    SyntaxNode* const repeated = open(Kind::block);
    adopt(node, repeated);
    statements(repeated);
    close(repeated);
    expect("until");
    adopt(node, expression());  // the locals of the block are visible
    scopes_.close_block(token_);
    scopes_.close_block(token_);
    return close(node);
}

SyntaxNode* LuaParser::function_statement() {
    SyntaxNode* const node = open(Kind::function_statement);
    take();
    SyntaxNode* target = open(Kind::name);
    target->word = name();
    if (target->word != nullptr) {
        close(target);
        resolve(target);
    } else {
        target->kind = Kind::missing;
    }
    bool is_method = false;
    while (!is_method && (at(".") || at(":"))) {
        is_method = at(":");
        target = around(Kind::member, target);
        take();
        target->word = member_name();
        close(target);
    }
    adopt(node, target);
    check_target(target);
    adopt(node, function(is_method));
    return close(node);
}

SyntaxNode* LuaParser::local() {
    SyntaxNode* const node = open(Kind::local);
    take();
    if (accept("function")) {
        node->kind = Kind::local_function;
        SyntaxNode* const declaration = open(Kind::declaration);
        declaration->word = name();
        adopt(node, close(declaration));
        if (declaration->word != nullptr) declare(declaration);
        adopt(node, function(false));
        return close(node);
    }
    SyntaxNode* const names = open(Kind::declarations);
    adopt(node, names);
    std::vector<bool> constant;
    bool closes = false;
    do {
        SyntaxNode* const declaration = open(Kind::declaration);
        declaration->word = name();
        constant.push_back(at("<"));
        if (accept("<")) {
            const bool is_close = token_->text == "close";
            if ((!is_close && token_->text != "const") || (is_close && std::exchange(closes, true))) wrong();
            name();
            expect(">");
        }
        adopt(names, close(declaration));
    } while (accept(","));
    close(names);
    if (accept("=")) adopt(node, expressions());
    std::size_t index = 0;
    for (SyntaxNode* each = names->child; each != nullptr; each = each->next, ++index) {
        if (each->word != nullptr) declare(each, constant[index]);
    }
    return close(node);
}

SyntaxNode* LuaParser::return_statement() {
    SyntaxNode* const node = open(Kind::return_statement);
    take();
    if (!ends_block() && !at(";")) adopt(node, expressions());
    accept(";");
    return close(node);
}

SyntaxNode* LuaParser::goto_statement() {
    SyntaxNode* const node = open(Kind::goto_statement);
    take();
    node->word = name();
    if (node->word != nullptr) scopes_.add_goto(node->word);
    return close(node);
}

SyntaxNode* LuaParser::label() {
    SyntaxNode* const node = open(Kind::label);
    take();
    node->word = name();
    expect("::");
    const Token* next = token_;
    for (;;) {
        if (next->is(";")) {
            ++next;
        } else if (next->is("::") && next[1].kind == Token::Kind::name && next[2].is("::")) {
            next += 3;
        } else {
            break;
        }
    }
    const bool is_last = next->kind == Token::Kind::end || next->is("end") || next->is("else") || next->is("elseif");
    if (node->word != nullptr) scopes_.add_label(node->word, is_last);
    return close(node);
}

// A call, or an assignment.
SyntaxNode* LuaParser::expression_statement() {
    SyntaxNode* const first = suffixed_expression();
    if (!at("=") && !at(",")) {
        if (!first->is(Kind::call) && !first->is(Kind::method_call)) wrong();
        return close(around(Kind::call_statement, first));
    }
    SyntaxNode* const targets = around(Kind::expressions, first);
    SyntaxNode* const node = around(Kind::assignment, targets);
    while (accept(",")) adopt(targets, suffixed_expression());
    close(targets);
    for (const SyntaxNode& target : *targets) check_target(&target);
    expect("=");
    adopt(node, expressions());
    return close(node);
}

// Checks that the target can be assigned.
void LuaParser::check_target(const SyntaxNode* target) {
    const bool is_place = target->is(Kind::name) || target->is(Kind::member) || target->is(Kind::subscript);
    if (!is_place) wrong();
    if (target->is(Kind::name) && target->variable != nullptr && target->variable->constant) wrong();
}

}  // namespace nezumi
