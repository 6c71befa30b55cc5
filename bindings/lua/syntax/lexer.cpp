// Splits Lua source into tokens by the rules of Lua's own lexer (llex.c of 5.4).
#include "bindings/lua/syntax/lexer.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "engine/base/names.hpp"

namespace nezumi {
namespace {

// Operators of several characters, the longest first.
constexpr std::array<std::string_view, 10> long_signs{"...", "..", "==", "~=", "<=", ">=", "//", "::", "<<", ">>"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_hex(char c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }
bool starts_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool is_line_end(char c) { return c == '\n' || c == '\r'; }

unsigned hex_value(char c) {
    if (is_digit(c)) return static_cast<unsigned>(c - '0');
    return static_cast<unsigned>((c | 0x20) - 'a' + 10);
}

// "12", "1.5e-3", "0x1F", "0x.8p1": whether Lua reads this as a number.
bool is_number(std::string_view text) {
    const bool hex = text.size() > 1 && text[0] == '0' && (text[1] | 0x20) == 'x';
    if (hex) text.remove_prefix(2);
    const auto skip_digits = [&text](auto is_one) {
        const auto end = std::find_if_not(text.begin(), text.end(), is_one);
        const auto count = static_cast<std::size_t>(end - text.begin());
        text.remove_prefix(count);
        return count;
    };
    bool (*const is_one)(char) = hex ? is_hex : is_digit;
    std::size_t digits = skip_digits(is_one);
    if (text.starts_with('.')) {
        text.remove_prefix(1);
        digits += skip_digits(is_one);
    }
    if (digits == 0) return false;
    if (text.empty()) return true;
    if ((text.front() | 0x20) != (hex ? 'p' : 'e')) return false;
    text.remove_prefix(1);
    if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
    return skip_digits(is_digit) > 0 && text.empty();
}

}  // namespace

bool Token::is_long() const {
    const std::size_t bracket = kind == Kind::comment ? 2 : 0;
    const std::size_t second = text.find_first_not_of('=', bracket + 1);
    return text.substr(bracket, 1) == "[" && second != std::string_view::npos && text[second] == '[';
}

std::string_view Token::inside() const {
    if (kind != Kind::string) return {};
    const std::size_t quote = text.front() == '[' ? text.find('[', 1) + 1 : 1;
    std::string_view held = text;
    held.remove_prefix(quote);
    const bool closed = !open && (text.front() == '[' || (held.ends_with(text.front())));
    if (closed) held.remove_suffix(std::min(quote, held.size()));
    return held;
}

std::string_view without_preamble(std::string_view source) {
    if (source.substr(0, 3) == "\xEF\xBB\xBF") source.remove_prefix(3);
    if (source.substr(0, 1) == "#") source.remove_prefix(std::min(source.find_first_of("\r\n"), source.size()));
    return source;
}

// Lua counts "\r\n" and "\n\r" as one line end.
void Lexer::advance() {
    const char c = peek();
    if (is_line_end(c)) {
        const char following = peek(1);
        if (is_line_end(following) && following != c) ++at_;
        ++line_;
        line_start_ = at_ + 1;
    }
    ++at_;
}

void Lexer::skip_blanks() {
    while (at_ < source_.size() && is_blank(peek())) advance();
}

// [[ or [==[, which has level 2.
bool Lexer::at_long_bracket(std::size_t& level) const {
    level = 0;
    while (peek(1 + level) == '=') ++level;
    return peek() == '[' && peek(1 + level) == '[';
}

void Lexer::skip_long_bracket(std::size_t level, Token& token) {
    at_ += level + 2;
    while (at_ < source_.size()) {
        if (peek() == ']' && peek(1 + level) == ']' &&
            source_.substr(at_ + 1, level).find_first_not_of('=') == std::string_view::npos) {
            at_ += level + 2;
            return;
        }
        advance();
    }
    token.open = true;
}

void Lexer::skip_comment(Token& token) {
    at_ += 2;
    std::size_t level = 0;
    if (at_long_bracket(level)) return skip_long_bracket(level, token);
    while (at_ < source_.size() && !is_line_end(peek())) ++at_;
}

void Lexer::skip_string(Token& token) {
    const char quote = peek();
    ++at_;
    while (at_ < source_.size() && peek() != quote) {
        if (is_line_end(peek())) {
            token.malformed = true;
            return;
        }
        if (peek() == '\\') {
            skip_escape(token);
        } else {
            ++at_;
        }
    }
    token.open = at_ >= source_.size();
    ++at_;
}

void Lexer::skip_escape(Token& token) {
    ++at_;
    const char c = peek();
    if (is_digit(c)) {
        unsigned value = 0;
        for (int i = 0; i < 3 && is_digit(peek()); ++i, ++at_) value = value * 10 + hex_value(peek());
        if (value > 255) token.malformed = true;
        return;
    }
    if (at_ >= source_.size()) return;
    advance();
    if (c == 'z') {
        skip_blanks();
    } else if (c == 'x') {
        for (int i = 0; i < 2; ++i) {
            if (!is_hex(peek())) {
                token.malformed = true;
                return;
            }
            ++at_;
        }
    } else if (c == 'u') {
        constexpr std::uint64_t most = 0x7FFFFFFF;
        std::uint64_t value = 0;
        bool fits = peek() == '{' && is_hex(peek(1));
        if (peek() == '{') ++at_;
        for (; is_hex(peek()); ++at_) {
            value = std::min<std::uint64_t>(value * 16 + hex_value(peek()), most + 1);
        }
        fits = fits && value <= most && peek() == '}';
        if (peek() == '}') ++at_;
        if (!fits) token.malformed = true;
    } else if (!is_line_end(c) && std::string_view("abfnrtv\\\"'").find(c) == std::string_view::npos) {
        token.malformed = true;
    }
}

void Lexer::skip_number(Token& token) {
    const std::size_t start = at_;
    const bool hex = peek() == '0' && (peek(1) | 0x20) == 'x';
    if (hex) at_ += 2;
    for (;;) {
        if ((peek() | 0x20) == (hex ? 'p' : 'e')) {
            ++at_;
            if (peek() == '+' || peek() == '-') ++at_;
        } else if (is_hex(peek()) || peek() == '.') {
            ++at_;
        } else {
            break;
        }
    }
    if (starts_name(peek())) ++at_;
    token.malformed = !is_number(source_.substr(start, at_ - start));
}

Token Lexer::next() {
    skip_blanks();
    Token token;
    token.line = line_;
    token.column = static_cast<int>(at_ - line_start_) + 1;
    token.text = source_.substr(at_, 0);
    if (at_ >= source_.size()) return token;

    const std::size_t start = at_;
    const char c = peek();
    std::size_t level = 0;
    if (starts_name(c)) {
        while (starts_name(peek()) || is_digit(peek())) ++at_;
        token.kind = is_keyword(source_.substr(start, at_ - start)) ? Token::Kind::keyword : Token::Kind::name;
    } else if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
        token.kind = Token::Kind::number;
        skip_number(token);
    } else if (c == '"' || c == '\'') {
        token.kind = Token::Kind::string;
        skip_string(token);
    } else if (at_long_bracket(level)) {
        token.kind = Token::Kind::string;
        skip_long_bracket(level, token);
    } else if (c == '-' && peek(1) == '-') {
        token.kind = Token::Kind::comment;
        skip_comment(token);
    } else {
        token.kind = Token::Kind::sign;
        const auto rest = source_.substr(at_);
        const auto* sign = std::find_if(long_signs.begin(), long_signs.end(),
                                        [rest](std::string_view text) { return rest.substr(0, text.size()) == text; });
        at_ += sign != long_signs.end() ? sign->size() : 1;
    }
    at_ = std::min(at_, source_.size());
    token.text = source_.substr(start, at_ - start);
    return token;
}

}  // namespace nezumi
