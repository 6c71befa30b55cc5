// Reads the words before the cursor as Lua does.
#include "bindings/console/cursor_text.hpp"

#include <algorithm>
#include <optional>
#include <span>

#include "bindings/lua/sandbox/lexer.hpp"

namespace nezumi {
namespace {

using Kind = Token::Kind;
using Tokens = std::span<const Token>;

bool is_word(const Token& token) { return token.kind == Kind::name || token.kind == Kind::keyword; }

// What a string literal holds, as it is written: without its quotes or brackets. Nothing for a number.
std::string_view inside(const Token& token) {
    std::string_view text = token.text;
    std::size_t quote = 1;
    if (text.front() == '[') {
        quote = text.find('[', 1) + 1;
    } else if (text.front() != '"' && text.front() != '\'') {
        return {};
    }
    text.remove_prefix(quote);
    if (!token.open) text.remove_suffix(std::min(quote, text.size()));
    return text;
}

// Takes `name` or `["name"]` from the end. False for anything else.
bool take_name(Tokens& tokens, std::string& name) {
    if (tokens.empty()) return false;
    if (is_word(tokens.back())) {
        name = tokens.back().text;
        tokens = tokens.first(tokens.size() - 1);
        return true;
    }
    if (tokens.size() < 4 || !tokens.back().is("]") || !tokens[tokens.size() - 3].is("[")) return false;
    name = inside(tokens[tokens.size() - 2]);
    tokens = tokens.first(tokens.size() - 3);
    return !name.empty();
}

// The chain of names whose part begins at `from`, behind these tokens of `text`.
NameAtCursor name_before(Tokens tokens, std::size_t from, std::string_view text) {
    NameAtCursor result;
    result.from = result.begin = from;
    if (tokens.empty() || !(tokens.back().is(".") || tokens.back().is(":"))) return result;
    result.separator = tokens.back().text.front();
    tokens = tokens.first(tokens.size() - 1);
    for (;;) {
        std::string name;
        const bool subscript = !tokens.empty() && tokens.back().is("]");
        if (!take_name(tokens, name)) {
            result.broken = true;
            break;
        }
        result.begin = static_cast<std::size_t>(tokens.data()[tokens.size()].text.data() - text.data());
        result.chain.push_back(std::move(name));
        if (subscript) continue;  // what it is a member of
        if (tokens.empty() || !tokens.back().is(".")) break;
        tokens = tokens.first(tokens.size() - 1);
    }
    std::reverse(result.chain.begin(), result.chain.end());
    return result;
}

// The names of `controller.out`, where these tokens are that and nothing else.
std::vector<std::string> chain_of(Tokens tokens) {
    std::string last;
    const bool subscript = !tokens.empty() && tokens.back().is("]");
    if (!take_name(tokens, last)) return {};
    std::vector<std::string> chain;
    if (!tokens.empty() && subscript) {
        chain = chain_of(tokens);
        if (chain.empty()) return {};
    } else if (!tokens.empty()) {
        NameAtCursor before = name_before(tokens, 0, tokens.front().text);
        if (before.separator != '.' || before.broken) return {};
        chain = std::move(before.chain);
    }
    chain.push_back(std::move(last));
    return chain;
}

// The bracket of any kind that is open behind these tokens: the number of tokens before it; none: there is none.
std::optional<std::size_t> open_bracket(Tokens tokens) {
    int depth = 0;
    for (std::size_t at = tokens.size(); at > 0; --at) {
        const Token& token = tokens[at - 1];
        if (token.is(")") || token.is("]") || token.is("}")) ++depth;
        if ((token.is("(") || token.is("[") || token.is("{")) && depth-- == 0) return at - 1;
    }
    return std::nullopt;
}

struct Before {
    std::vector<Token> tokens;
    bool comment = false;
};

Before read(std::string_view text) {
    Before before;
    Lexer lexer(text);
    for (Token token = lexer.next(); token.kind != Kind::end; token = lexer.next()) before.tokens.push_back(token);
    before.comment = lexer.ends_in_comment();
    return before;
}

// Finds the call whose argument comes after these tokens.
void find_callee(TextAtCursor& result, Tokens before, std::string_view text) {
    std::size_t callee = before.size();
    if (before.size() > 1 && before.back().kind == Kind::literal && is_word(before[before.size() - 2])) {
        result.first = inside(before.back());  // `robot "mouse" { ... }`
        result.argument = 2;
        --callee;
    } else if (!before.empty() && !is_word(before.back())) {
        int depth = 0;
        std::size_t bracket = before.size();
        for (; bracket > 0; --bracket) {
            const Token& token = before[bracket - 1];
            if (token.is(")") || token.is("]") || token.is("}")) ++depth;
            if (token.is("(") || token.is("[") || token.is("{")) {
                if (depth-- == 0) break;
            }
            if (depth == 0 && token.is(",")) ++result.argument;
        }
        if (bracket == 0 || !before[bracket - 1].is("(")) return;
        if (bracket < before.size() && before[bracket].kind == Kind::literal) result.first = inside(before[bracket]);
        const Tokens arguments = before.subspan(bracket);
        const auto comma = std::find_if(arguments.begin(), arguments.end(), [](const Token& t) { return t.is(","); });
        result.first_chain = chain_of(arguments.first(static_cast<std::size_t>(comma - arguments.begin())));
        callee = bracket - 1;
    }
    if (callee == 0 || !is_word(before[callee - 1])) return;
    const Token& word = before[callee - 1];
    result.callee =
        name_before(before.first(callee - 1), static_cast<std::size_t>(word.text.data() - text.data()), text);
    result.word = word.text;
}

// The last token ends at the cursor.
bool touches_cursor(Tokens tokens, std::string_view text) {
    return !tokens.empty() && tokens.back().text.data() + tokens.back().text.size() == text.data() + text.size();
}

}  // namespace

NameAtCursor name_at_cursor(std::string_view text) {
    const Before before = read(text);
    Tokens tokens = before.tokens;
    std::size_t from = text.size();
    const bool touches = touches_cursor(tokens, text);
    if (touches && tokens.back().kind == Kind::literal) {  // "3." is a number
        NameAtCursor result;
        result.from = from;
        result.separator = '.';
        result.broken = true;
        return result;
    }
    if (touches && is_word(tokens.back())) {
        from -= tokens.back().text.size();
        tokens = tokens.first(tokens.size() - 1);
    }
    return name_before(tokens, from, text);
}

TextAtCursor text_at_cursor(std::string_view text) {
    TextAtCursor result;
    const Before before = read(text);
    result.comment = before.comment;
    if (before.tokens.empty() || !before.tokens.back().open) return result;
    result.open = true;
    result.from = text.size() - inside(before.tokens.back()).size();
    Tokens tokens = Tokens(before.tokens).first(before.tokens.size() - 1);
    if (!tokens.empty() && tokens.back().is("=")) {
        tokens = tokens.first(tokens.size() - 1);
        const auto bracket = open_bracket(tokens);
        if (!bracket || !tokens[*bracket].is("{") || !take_name(tokens, result.field)) return result;
        tokens = Tokens(before.tokens).first(*bracket);
    }
    find_callee(result, tokens, text);
    return result;
}

TextAtCursor call_at_cursor(std::string_view text) {
    TextAtCursor result;
    const Before before = read(text);
    find_callee(result, before.tokens, text);
    return result;
}

FieldAtCursor field_at_cursor(std::string_view text) {
    FieldAtCursor result;
    const Before before = read(text);
    Tokens tokens = before.tokens;
    if (touches_cursor(tokens, text) && is_word(tokens.back())) tokens = tokens.first(tokens.size() - 1);
    if (tokens.empty() || !(tokens.back().is("{") || tokens.back().is(",") || tokens.back().is(";"))) return result;
    for (;;) {
        const auto bracket = open_bracket(tokens);
        if (!bracket || !tokens[*bracket].is("{")) return result;
        tokens = tokens.first(*bracket);
        if (tokens.empty() || !tokens.back().is("=")) break;
        tokens = tokens.first(tokens.size() - 1);
        std::string name;
        if (!take_name(tokens, name)) return result;
        result.path.insert(result.path.begin(), std::move(name));
    }
    find_callee(result.call, tokens, text);
    result.open = !result.call.word.empty();
    return result;
}

}  // namespace nezumi
