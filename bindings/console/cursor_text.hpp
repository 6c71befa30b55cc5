// What stands before the cursor of an input, as far as completing needs to understand it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/syntax/syntax_tree.hpp"

namespace nezumi {

/// `controller.config.sp` is the chain "controller", "config" and the part "sp".
struct NameAtCursor {
    std::vector<std::string> chain;  ///< names before the part; `x["in"]` counts as a name
    char separator = 0;              ///< '.' or ':' before the part; 0: the part begins the chain
    std::size_t from = 0;            ///< [bytes] where the part begins
    bool broken = false;             ///< what stands before the part is more than names: nothing is known of it
};

/// `connect("controller.out", "mo` is the word "connect", its second argument, and the text "mo".
struct TextAtCursor {
    bool open = false;                     ///< the cursor is in a quoted text
    std::size_t from = 0;                  ///< [bytes] where the text begins, behind its quote
    NameAtCursor callee;                   ///< what is called with it; its part is `word`
    std::string word;                      ///< "" for none
    std::string field;                     ///< of a table, where the text is the field's value: `{ script = "co`
    int argument = 1;                      ///< which one it is, from 1; 2 behind `robot "mouse"`
    std::string first;                     ///< the first argument, where that is a quoted text too
    std::vector<std::string> first_chain;  ///< the same, where it is a chain of names
};

/// `controller.out:write { v` is a field's name in the table that `controller.out:write` is called with; in
/// `write { position = { x` the table lies at "position".
struct FieldAtCursor {
    bool open = false;              ///< a field's name can stand here
    TextAtCursor call;              ///< what the table is an argument of; no text is open there
    std::vector<std::string> path;  ///< fields from that argument to the table around the cursor
};

class CursorText {
public:
    /// The text ends at the cursor, and must outlive this.
    explicit CursorText(std::string_view text);

    bool in_comment() const { return tree_.ends_in_comment(); }
    NameAtCursor name() const;
    TextAtCursor quoted() const;
    FieldAtCursor field() const;
    /// The call that the name at the cursor is an argument of.
    TextAtCursor call() const;

private:
    bool touches_cursor(const Token& token) const;
    NameAtCursor named(const SyntaxNode& node, const Token* separator) const;
    void find_call(TextAtCursor& result, const SyntaxNode& value) const;

    SyntaxTree tree_;
    const Token* last_ = nullptr;         // null: there is none
    const Token* part_ = nullptr;         // the word that ends at the cursor
    const Token* separator_ = nullptr;    // the '.' or ':' before it, or at the cursor
    const SyntaxNode* node_ = nullptr;    // the expression whose part that is
    const SyntaxNode* quoted_ = nullptr;  // the literal that is open
};

}  // namespace nezumi
