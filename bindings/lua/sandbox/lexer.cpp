// Splits Lua source into words.
#include "bindings/lua/sandbox/lexer.hpp"

#include <algorithm>
#include <array>

#include "engine/base/names.hpp"

namespace nezumi {
namespace {

// Longest first.
constexpr std::array<std::string_view, 10> long_signs{"...", "..", "==", "~=", "<=", ">=", "//", "::", "<<", ">>"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_hex(char c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }
bool starts_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

std::string_view without_preamble(std::string_view source) {
    if (source.substr(0, 3) == "\xEF\xBB\xBF") source.remove_prefix(3);
    if (source.substr(0, 1) == "#") source.remove_prefix(std::min(source.find_first_of("\r\n"), source.size()));
    return source;
}

// Lua counts "\r\n" and "\n\r" as one line end.
void Lexer::advance() {
    const char c = peek();
    if (c == '\n' || c == '\r') {
        const char following = peek(1);
        if ((following == '\n' || following == '\r') && following != c) ++at_;
        ++line_;
        line_start_ = at_ + 1;
    }
    ++at_;
}

// [[ or [==[, which has the level 2.
bool Lexer::at_long_bracket(std::size_t& level) const {
    level = 0;
    while (peek(1 + level) == '=') ++level;
    return peek() == '[' && peek(1 + level) == '[';
}

bool Lexer::skip_long_bracket(std::size_t level) {
    at_ += level + 2;
    while (at_ < source_.size()) {
        if (peek() == ']' && peek(1 + level) == ']' &&
            source_.substr(at_ + 1, level).find_first_not_of('=') == std::string_view::npos) {
            at_ += level + 2;
            return true;
        }
        advance();
    }
    return false;
}

void Lexer::skip_blanks() {
    std::size_t level = 0;
    while (at_ < source_.size()) {
        if (is_blank(peek())) {
            advance();
        } else if (peek() == '-' && peek(1) == '-') {
            at_ += 2;
            if (at_long_bracket(level)) {
                in_comment_ = !skip_long_bracket(level);
                continue;
            }
            while (at_ < source_.size() && peek() != '\n' && peek() != '\r') ++at_;
            in_comment_ = at_ == source_.size();
        } else {
            return;
        }
    }
}

bool Lexer::skip_string(char quote) {
    ++at_;
    while (at_ < source_.size() && peek() != quote) {
        if (peek() == '\n' || peek() == '\r') return true;  // a slip: a line ends it
        if (peek() == '\\') {
            ++at_;
            if (peek() == 'z') {  // skips the blanks that follow, line ends included
                ++at_;
                while (at_ < source_.size() && is_blank(peek())) advance();
                continue;
            }
            if (at_ >= source_.size()) return false;
        }
        advance();
    }
    if (at_ >= source_.size()) return false;
    ++at_;
    return true;
}

void Lexer::skip_number() {
    const bool hex = peek() == '0' && (peek(1) == 'x' || peek(1) == 'X');
    if (hex) at_ += 2;
    while (at_ < source_.size()) {
        const char c = peek();
        const bool exponent = hex ? (c == 'p' || c == 'P') : (c == 'e' || c == 'E');
        if (exponent && (peek(1) == '+' || peek(1) == '-')) {
            at_ += 2;
        } else if (is_hex(c) || c == '.' || exponent || c == 'x' || c == 'X') {
            ++at_;
        } else {
            return;
        }
    }
}

Token Lexer::next() {
    skip_blanks();
    Token token;
    token.line = line_;
    token.column = static_cast<int>(at_ - line_start_) + 1;
    if (at_ >= source_.size()) return token;

    const std::size_t start = at_;
    const char c = peek();
    if (starts_name(c)) {
        while (starts_name(peek()) || is_digit(peek())) ++at_;
        token.text = source_.substr(start, at_ - start);
        token.kind = is_keyword(token.text) ? Token::Kind::keyword : Token::Kind::name;
        return token;
    }
    token.kind = Token::Kind::literal;
    std::size_t level = 0;
    if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
        skip_number();
    } else if (c == '"' || c == '\'') {
        token.open = !skip_string(c);
    } else if (at_long_bracket(level)) {
        token.open = !skip_long_bracket(level);
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
