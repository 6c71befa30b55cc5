// The one parser of Lua's syntax: a tree of a source text, with the local variable that each name means. Questions
// about a text are functions over the tree.
#pragma once

#include <cstddef>
#include <deque>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/syntax/lexer.hpp"

namespace nezumi {

/// A local variable, a parameter, or the `self` of a method.
struct LocalName {
    std::string_view name;
    const Token* place = nullptr;  ///< its name in the declaration; for `self`, the bracket of the method
    const Token* from = nullptr;   ///< the first token where it is visible
    const Token* to = nullptr;     ///< after the last one
    bool constant = false;         ///< <const> or <close>
};

/// A statement, an expression, or a list of them. The comments on `Kind` list the children of a node.
struct SyntaxNode {
    enum class Kind : unsigned char {
        // Lists.
        block,         ///< statements
        expressions,   ///< expressions; the node of a call's arguments includes the brackets
        declarations,  ///< declarations; the node of a function's parameters includes the brackets
        // Statements.
        assignment,          ///< expressions that are assigned, expressions
        call_statement,      ///< call
        local,               ///< declarations, and expressions if there are any
        local_function,      ///< declaration, function
        function_statement,  ///< name or members of one, function
        do_block,            ///< block
        while_loop,          ///< expression, block
        repeat_loop,         ///< block, expression
        for_loop,            ///< declarations, expressions, block
        branches,            ///< expression, block, expression, block, ..., and the block of `else`
        return_statement,    ///< expressions
        break_statement,
        goto_statement,
        label,
        // Expressions.
        literal,      ///< a number, string, nil, true, false or ...
        name,         ///< a variable
        function,     ///< declarations, block
        table,        ///< its elements and fields
        parenthesis,  ///< expression
        unary,        ///< expression
        binary,       ///< expression, expression
        member,       ///< `a.b`: a; also `a:b` where a method is defined
        subscript,    ///< `a[b]`: a, b
        call,         ///< `a(b)`: a, expressions
        method_call,  ///< `a:b(c)`: a, expressions
        missing,      ///< nothing where an expression is expected
        // Within lists.
        declaration,  ///< a variable that is declared
        element,      ///< of a table: expression
        field,        ///< `a = b`: b
        keyed_field,  ///< `[a] = b`: a, b
    };

    Kind kind = Kind::missing;
    const Token* first = nullptr;         ///< its first token
    const Token* end = nullptr;           ///< the token after its last one
    const Token* word = nullptr;          ///< name, declaration, member, method_call, field, goto, label: the name;
                                          ///< unary, binary: the operator; null where the text lacks it
    const LocalName* variable = nullptr;  ///< name, declaration: the local variable; null: it is a global
    SyntaxNode* parent = nullptr;
    SyntaxNode* child = nullptr;  ///< the first one
    SyntaxNode* last = nullptr;   ///< the last one
    SyntaxNode* next = nullptr;   ///< of the same parent

    bool is(Kind which) const { return kind == which; }
    /// The source from its first to its last token.
    std::string_view text() const;
    std::string_view word_text() const { return word != nullptr ? word->text : std::string_view(); }
    /// The child with this index, from 0; null if there are fewer.
    const SyntaxNode* at(std::size_t index) const;
    std::size_t count() const;
    /// The content of a string literal, with its escapes; nothing for any other node.
    std::optional<std::string_view> string() const;
    /// Whether this is a name of this global.
    bool is_global(std::string_view name) const;
    /// The outermost expression that has this one as an operand: for `b` in `f(a or (b))` it is `a or (b)`.
    const SyntaxNode& operand_of() const;

    /// For `for (const SyntaxNode& child : node)`.
    struct Children {
        using iterator_category = std::forward_iterator_tag;
        using value_type = SyntaxNode;
        using difference_type = std::ptrdiff_t;
        using pointer = const SyntaxNode*;
        using reference = const SyntaxNode&;
        const SyntaxNode* node = nullptr;
        reference operator*() const { return *node; }
        pointer operator->() const { return node; }
        Children& operator++() {
            node = node->next;
            return *this;
        }
        bool operator==(const Children&) const = default;
    };
};

inline SyntaxNode::Children begin(const SyntaxNode& node) { return {node.child}; }
inline SyntaxNode::Children end(const SyntaxNode& /*node*/) { return {}; }

/// Reads a text of Lua 5.4. A text with errors also has a tree, as far as possible; a text that ends too early has open
/// nodes.
class SyntaxTree {
public:
    enum class Dialect {
        lua,
        console,  ///< a keyword after a dot is a name: `controller.in`
    };

    /// The text must outlive the tree. For a file, it is the text without its preamble.
    explicit SyntaxTree(std::string_view source, Dialect dialect = Dialect::lua);
    SyntaxTree(const SyntaxTree&) = delete;  // nodes refer to each other
    SyntaxTree& operator=(const SyntaxTree&) = delete;

    std::string_view source() const { return source_; }
    /// All except comments; the last one is Kind::end.
    const std::vector<Token>& tokens() const { return tokens_; }
    /// The block of the text.
    const SyntaxNode& root() const { return nodes_.front(); }
    /// All nodes. Nodes of one token are in the order of the text.
    const std::deque<SyntaxNode>& nodes() const { return nodes_; }
    const std::deque<LocalName>& locals() const { return locals_; }

    /// The location of the first syntax error; null if there is none. Lua's limits (200 local variables, levels of
    /// nesting) are not checked.
    const Token* error() const { return error_; }
    /// Whether the error is that the text ends too early.
    bool ends_early() const;
    /// Whether the text ends in a comment.
    bool ends_in_comment() const { return ends_in_comment_; }

    /// [bytes] offset of a token.
    std::size_t offset(const Token& token) const {
        return static_cast<std::size_t>(token.text.data() - source_.data());
    }

private:
    friend class LuaParser;

    std::string_view source_;
    std::vector<Token> tokens_;
    std::deque<SyntaxNode> nodes_;
    std::deque<LocalName> locals_;
    const Token* error_ = nullptr;
    bool ends_in_comment_ = false;
};

/// The names of `controller.out`, or of `controller["out"].x`; nothing for any other expression.
std::optional<std::vector<std::string>> name_chain(const SyntaxNode& expression);

/// A field by its name.
struct FieldName {
    std::string_view name;
    const Token* place;
};

/// The name `b` if `expression` is the `a` of `a.b` or `a["b"]`; nothing for any other expression.
std::optional<FieldName> field_of(const SyntaxNode& expression);

/// Whether the expression is the target of an assignment, or of `function a.b()`.
bool is_assigned(const SyntaxNode& expression);

}  // namespace nezumi
