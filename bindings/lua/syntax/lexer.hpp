// The tokens of a Lua source text, with their locations.
#pragma once

#include <cstddef>
#include <string_view>

namespace nezumi {

/// One token. Blanks are not tokens.
struct Token {
    enum class Kind : unsigned char { name, keyword, number, string, sign, comment, end } kind = Kind::end;
    std::string_view text{};  ///< as in the source: a string with its quotes, a comment with its dashes
    int line = 1;             ///< from 1
    int column = 1;           ///< from 1 [bytes]
    bool open = false;        ///< a string, or a comment in long brackets, without its end
    bool malformed = false;   ///< a number or string that Lua refuses: "3x", "\q", a string that a line ends

    bool is(std::string_view word) const { return text == word && (kind == Kind::keyword || kind == Kind::sign); }
    /// Whether this is a name or a keyword.
    bool is_word() const { return kind == Kind::name || kind == Kind::keyword; }
    /// Whether this is a string or comment in long brackets: [==[ ... ]==].
    bool is_long() const;
    /// The content of a string without its quotes or brackets, with its escapes. Nothing for any other token.
    std::string_view inside() const;
};

/// A source text without a byte order mark. A first line for the shell ("#!...") becomes empty, so line numbers stay
/// the same.
std::string_view without_preamble(std::string_view source);

/// Splits a source text into tokens, like Lua. A text that is not Lua gives some sequence of tokens, and always ends.
class Lexer {
public:
    explicit Lexer(std::string_view source) : source_(source) {}

    /// The next token; at the end always Kind::end.
    Token next();

private:
    char peek(std::size_t ahead = 0) const { return at_ + ahead < source_.size() ? source_[at_ + ahead] : '\0'; }
    void advance();
    void skip_blanks();
    bool at_long_bracket(std::size_t& level) const;
    // These functions set `open` and `malformed`.
    void skip_long_bracket(std::size_t level, Token& token);
    void skip_comment(Token& token);
    void skip_string(Token& token);
    void skip_escape(Token& token);
    void skip_number(Token& token);

    std::string_view source_;
    std::size_t at_ = 0;
    std::size_t line_start_ = 0;
    int line_ = 1;
};

}  // namespace nezumi
