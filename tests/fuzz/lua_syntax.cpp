// Reads anything as Lua: the reader takes what Lua takes and refuses what Lua refuses, in whole and up to any cursor.
#include "tests/fuzz/lua_syntax.hpp"

#include <cstdint>

#include "bindings/console/cursor_text.hpp"
#include "bindings/console/input_text.hpp"
#include "bindings/lua/files/file_source.hpp"
#include "bindings/lua/syntax/first_comment.hpp"
#include "bindings/lua/syntax/globals.hpp"
#include "bindings/scenario/condition_source.hpp"
#include "bindings/scenario/method_scan.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

namespace {

// Each node lies within its parent, and its children follow each other.
void check_tree(const SyntaxTree& tree) {
    for (const SyntaxNode& node : tree.nodes()) {
        require(node.first <= node.end);
        const Token* at = node.first;
        for (const SyntaxNode& child : node) {
            require(child.parent == &node && child.first >= at && child.end <= node.end);
            at = child.end;
        }
    }
}

void check_cursor(std::string_view text) {
    const CursorText cursor(text);
    require(cursor.name().from <= text.size() && cursor.quoted().from <= text.size());
    static_cast<void>(cursor.field());
    static_cast<void>(cursor.call());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const LuaReference lua;
    const std::string text(reinterpret_cast<const char*>(data), size);
    require(lua.agrees(text));
    for (const auto dialect : {SyntaxTree::Dialect::lua, SyntaxTree::Dialect::console}) {
        check_tree(SyntaxTree(text, dialect));
    }
    for (std::size_t end = 0; end <= size; end += 1 + size / 16) check_cursor(text.substr(0, end));
    static_cast<void>(is_complete_input(text));
    require(!lua.says(text).empty() || with_keyword_names(text) == text);
    static_cast<void>(with_plotted_names(text));
    static_cast<void>(FileSource(text, "text"));
    static_cast<void>(first_comment(text));
    static_cast<void>(observe_function(SyntaxTree(text), {.first_line = 1, .last_line = 1}, "hook"));
    for (const Error& error : check_globals(SyntaxTree(text), "text", {})) check(error);
    for (const Error& error : unknown_methods(text, "text", {"run"})) check(error);
    return 0;
}
