// Analyses the text before the cursor for completion.
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
    char separator = 0;              ///< '.' or ':' before the part; 0: the part is the first name
    std::size_t from = 0;            ///< [bytes] where the part begins
    bool broken = false;             ///< an expression other than names stands before the part, so its value is unknown
};

/// In `connect("controller.out", "mo`, `callee` is "connect", `argument` is 2, and the quoted text is "mo".
struct TextAtCursor {
    bool open = false;                     ///< the cursor is in a quoted text
    std::size_t from = 0;                  ///< [bytes] where the text begins, after its quote
    NameAtCursor callee;                   ///< the function that is called; its name is `word`
    std::string word;                      ///< "" for none
    std::string field;                     ///< the field of a table whose value is the text: `{ script = "co`
    int argument = 1;                      ///< number of the argument, from 1; 2 for the table after `robot "mouse"`
    std::string first;                     ///< the first argument, if it is a quoted text
    std::vector<std::string> first_chain;  ///< the first argument, if it is a chain of names
};

/// `controller.out:write { v` is the name of a field in the table argument of `controller.out:write`. In `write {
/// position = { x` the table is at "position".
struct FieldAtCursor {
    bool open = false;              ///< the name of a field can stand here
    TextAtCursor call;              ///< the call that has the table as an argument; no text is open in it
    std::vector<std::string> path;  ///< fields from the argument to the table around the cursor
};

class CursorText {
public:
    /// The text ends at the cursor and must outlive this object.
    explicit CursorText(std::string_view text);

    bool in_comment() const { return tree_.ends_in_comment(); }
    NameAtCursor name() const;
    TextAtCursor quoted() const;
    FieldAtCursor field() const;
    /// The call that has the name at the cursor as an argument.
    TextAtCursor call() const;

private:
    bool touches_cursor(const Token& token) const;
    NameAtCursor named(const SyntaxNode& node, const Token* separator) const;
    void find_call(TextAtCursor& result, const SyntaxNode& value) const;

    SyntaxTree tree_;
    const Token* last_ = nullptr;         // null: the text has no token
    const Token* part_ = nullptr;         // the word that ends at the cursor
    const Token* separator_ = nullptr;    // the '.' or ':' before it, or at the cursor
    const SyntaxNode* node_ = nullptr;    // the expression that the part belongs to
    const SyntaxNode* quoted_ = nullptr;  // the literal that is not closed
};

}  // namespace nezumi
