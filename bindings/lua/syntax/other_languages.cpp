// Compares the tokens around the first error.
#include "bindings/lua/syntax/other_languages.hpp"

#include <algorithm>

namespace nezumi {
namespace {

struct Foreign {
    std::string_view text;  // two signs without a blank between
    std::string_view hint;
};

constexpr std::string_view no_compound = "Lua has no such assignment: write x = x + 1";

constexpr std::string_view comment = "a comment begins with -- in Lua";

constexpr Foreign signs[] = {
    {"!=", "it is ~= in Lua"},
    {"&&", "it is `and` in Lua"},
    {"||", "it is `or` in Lua"},
    {"++", no_compound},
    {"+=", no_compound},
    {"-=", no_compound},
    {"*=", no_compound},
    {"/=", no_compound},
    {"%=", no_compound},
    {"..=", no_compound},
    {"/*", comment},
};

// Words of other languages before the error.
constexpr Foreign words[] = {
    {"elif", "it is `elseif` in Lua"},
    {"elsif", "it is `elseif` in Lua"},
    {"def", "it is `function` in Lua"},
    {"func", "it is `function` in Lua"},
    {"fn", "it is `function` in Lua"},
    {"var", "it is `local` in Lua"},
    {"let", "it is `local` in Lua"},
    {"const", "it is `local` in Lua"},
    {"import", "`local name = require \"name\"` loads a module in Lua"},
    {"class", "Lua has no classes: a table has fields and functions"},
    {"try", "pcall(f) calls f and catches its errors in Lua"},
    {"continue", "Lua has no continue: `goto continue` goes to ::continue:: at the loop's end"},
};

constexpr std::string_view no_braces = "a block is `then ... end` or `do ... end` in Lua";

bool touch(const Token& a, const Token& b) { return a.text.data() + a.text.size() == b.text.data(); }

template <std::size_t Size>
std::string_view hint_of(const Foreign (&table)[Size], std::string_view text) {
    const auto* const found =
        std::find_if(std::begin(table), std::end(table), [&](const Foreign& each) { return each.text == text; });
    return found != std::end(table) ? found->hint : std::string_view();
}

// `if x = 3 then`
bool is_condition_before(const SyntaxTree& tree, const Token* token) {
    using Kind = SyntaxNode::Kind;
    return std::any_of(tree.nodes().begin(), tree.nodes().end(), [token](const SyntaxNode& node) {
        const bool has_condition = node.is(Kind::branches) || node.is(Kind::while_loop);
        return has_condition && std::any_of(begin(node), end(node), [token](const SyntaxNode& child) {
                   return !child.is(Kind::block) && !child.is(Kind::missing) && child.end == token;
               });
    });
}

}  // namespace

std::string_view other_language_hint(const SyntaxTree& tree) {
    const Token* const wrong = tree.error();
    if (wrong == nullptr || wrong->kind == Token::Kind::end) return "";
    const Token* const before = wrong != tree.tokens().data() ? wrong - 1 : nullptr;
    for (const Token* const first : {wrong, before}) {
        if (first == nullptr || !touch(*first, first[1])) continue;
        const std::string both = std::string(first->text) + std::string(first[1].text);
        if (const std::string_view hint = hint_of(signs, both); !hint.empty()) return hint;
    }
    if (wrong->is("!")) return "it is `not` in Lua";
    if (wrong->is("//") || wrong->is("#")) return comment;
    if (wrong->is("?")) return "it is `condition and a or b` in Lua";
    if (wrong->is("=") && is_condition_before(tree, wrong)) return "== compares in Lua, and = assigns";
    if (before != nullptr && before->kind == Token::Kind::name) {
        if (const std::string_view hint = hint_of(words, before->text); !hint.empty()) return hint;
    }
    if (wrong->is("{") || wrong->is(":") || (before != nullptr && before->is("{") && wrong->is("}"))) return no_braces;
    if (wrong->is("[")) return "a list is { 1, 2 } in Lua";
    return "";
}

}  // namespace nezumi
