// Reads backwards from the cursor, and forwards to know what is a text.
#include "bindings/console/cursor_text.hpp"

#include <algorithm>
#include <cctype>

namespace nezumi {
namespace {

bool is_name_char(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.remove_suffix(1);
    return text;
}

// Where the name begins that ends the text.
std::size_t name_begin(std::string_view text) {
    std::size_t at = text.size();
    while (at > 0 && is_name_char(text[at - 1])) --at;
    return at;
}

// Takes `["name"]` from the end of the text. Returns false when it is none.
bool take_subscript(std::string_view& text, std::string& name) {
    if (!text.ends_with(']') || text.size() < 4) return false;
    const char quote = text[text.size() - 2];
    if (quote != '"' && quote != '\'') return false;
    const std::size_t begin = text.rfind(quote, text.size() - 3);
    if (begin == std::string_view::npos || begin == 0 || text[begin - 1] != '[') return false;
    name = text.substr(begin + 1, text.size() - begin - 3);
    text = text.substr(0, begin - 1);
    return true;
}

}  // namespace

NameAtCursor name_at_cursor(std::string_view text) {
    NameAtCursor result;
    result.from = name_begin(text);
    std::string_view rest = text.substr(0, result.from);
    if (rest.empty() || (rest.back() != '.' && rest.back() != ':') || rest.ends_with("..")) return result;
    result.separator = rest.back();
    rest.remove_suffix(1);
    for (;;) {
        std::string name;
        if (take_subscript(rest, name)) {
            result.chain.push_back(name);
            continue;  // what it is a member of
        }
        const std::size_t begin = name_begin(rest);
        if (begin == rest.size() || std::isdigit(static_cast<unsigned char>(rest[begin])) != 0) {
            result.broken = true;
            break;
        }
        result.chain.emplace_back(rest.substr(begin));
        rest = rest.substr(0, begin);
        if (!rest.ends_with('.') || rest.ends_with("..")) break;
        rest.remove_suffix(1);
    }
    std::reverse(result.chain.begin(), result.chain.end());
    return result;
}

TextAtCursor text_at_cursor(std::string_view text) {
    TextAtCursor result;
    char quote = 0;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quote != 0) {
            if (c == '\\') {
                ++i;
            } else if (c == quote || c == '\n') {
                quote = 0;
            }
        } else if (c == '"' || c == '\'') {
            quote = c;
            begin = i;
        } else if (c == '-' && text.substr(i, 2) == "--") {
            const std::size_t end = text.find('\n', i);
            result.comment = end == std::string_view::npos;
            if (result.comment) return result;
            i = end;
        }
    }
    if (quote == 0) return result;
    result.open = true;
    result.from = begin + 1;
    std::string_view before = without_blanks(text.substr(0, begin));
    if (before.ends_with(',')) {
        result.argument = 2;
        before = without_blanks(before.substr(0, before.size() - 1));
        const std::size_t bracket = before.rfind('(');
        if (bracket == std::string_view::npos) return result;
        const std::string_view first = before.substr(bracket + 1);
        if (first.size() > 1 && (first.front() == '"' || first.front() == '\'') && first.back() == first.front())
            result.first = first.substr(1, first.size() - 2);
        before = before.substr(0, bracket + 1);
    }
    if (before.ends_with('(')) before = without_blanks(before.substr(0, before.size() - 1));
    result.callee = name_at_cursor(before);
    result.word = before.substr(result.callee.from);
    return result;
}

}  // namespace nezumi
