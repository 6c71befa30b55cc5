// The grammar of Lua 5.4: fills a SyntaxTree from its tokens.
#pragma once

#include <string_view>

#include "bindings/lua/syntax/scopes.hpp"
#include "bindings/lua/syntax/syntax_tree.hpp"

namespace nezumi {

/// Recursive descent, with a function for each rule. A missing part is reported once and then assumed, so each text has
/// a tree, and nodes can be open at its end.
class LuaParser {
public:
    LuaParser(SyntaxTree& tree, SyntaxTree::Dialect dialect)
        : tree_(tree),
          keyword_members_(dialect == SyntaxTree::Dialect::console),
          scopes_(tree.locals_),
          token_(tree.tokens_.data()) {}

    void read();

private:
    using Kind = SyntaxNode::Kind;

    /// Counts a level of nesting during its lifetime. A text that is nested too deeply is not read further.
    class Level {
    public:
        explicit Level(LuaParser& parser) : parser_(parser) {
            if (++parser_.depth_ <= depth_limit) return;
            parser_.wrong();
            parser_.token_ = &parser_.tree_.tokens_.back();
        }
        ~Level() { --parser_.depth_; }
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;

    private:
        LuaParser& parser_;
    };

    // Limit of nested expressions and statements. Lua counts the same, with a slightly smaller limit (LUAI_MAXCCALLS).
    static constexpr int depth_limit = 200;

    bool at(std::string_view word) const { return token_->is(word); }
    bool at_end() const { return token_->kind == Token::Kind::end; }
    bool at_value() const;
    bool ends_block() const;
    const Token* take() { return at_end() ? token_ : token_++; }
    bool accept(std::string_view word);
    void expect(std::string_view word);
    void wrong() { wrong(token_); }
    void wrong(const Token* token);

    SyntaxNode* open(Kind kind);
    SyntaxNode* around(Kind kind, SyntaxNode* first);
    SyntaxNode* close(SyntaxNode* node);
    static void adopt(SyntaxNode* parent, SyntaxNode* child);

    const Token* name();
    const Token* member_name();
    void resolve(SyntaxNode* name);
    void declare(SyntaxNode* declaration, bool constant = false);

    SyntaxNode* block(bool is_loop = false);
    void statements(SyntaxNode* block);
    SyntaxNode* statement();
    SyntaxNode* branches();
    SyntaxNode* while_loop();
    SyntaxNode* for_loop();
    SyntaxNode* repeat_loop();
    SyntaxNode* local();
    SyntaxNode* function_statement();
    SyntaxNode* return_statement();
    SyntaxNode* goto_statement();
    SyntaxNode* label();
    SyntaxNode* expression_statement();
    void check_target(const SyntaxNode* target);

    SyntaxNode* expressions();
    SyntaxNode* expression(int limit = 0);
    SyntaxNode* simple_expression();
    SyntaxNode* suffixed_expression();
    SyntaxNode* primary_expression();
    SyntaxNode* arguments();
    SyntaxNode* table();
    SyntaxNode* table_entry();
    SyntaxNode* function(bool is_method);

    SyntaxTree& tree_;
    bool keyword_members_;
    Scopes scopes_;
    const Token* token_;
    int depth_ = 0;
};

}  // namespace nezumi
