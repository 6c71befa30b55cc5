// What stands before the cursor of an input, as far as completing needs to understand it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nezumi {

/// `controller.config.sp` is the chain "controller", "config" and the part "sp".
struct NameAtCursor {
    std::vector<std::string> chain;  ///< names before the part; `x["in"]` counts as a name
    char separator = 0;              ///< '.' or ':' before the part; 0: the part begins the chain
    std::size_t from = 0;            ///< [bytes] where the part begins
    std::size_t begin = 0;           ///< [bytes] where the chain begins
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
    bool comment = false;                  ///< the cursor is in a comment
};

/// `controller.out:write { v` is a field's name in the table that `controller.out:write` is called with; in
/// `write { position = { x` the table lies at "position".
struct FieldAtCursor {
    bool open = false;              ///< a field's name can stand here
    TextAtCursor call;              ///< what the table is an argument of; no text is open there
    std::vector<std::string> path;  ///< fields from that argument to the table around the cursor
};

/// `text` ends at the cursor.
TextAtCursor text_at_cursor(std::string_view text);
NameAtCursor name_at_cursor(std::string_view text);
FieldAtCursor field_at_cursor(std::string_view text);
/// The call whose argument begins at the cursor.
TextAtCursor call_at_cursor(std::string_view text);

}  // namespace nezumi
