// The words of a Lua source text, with their places.
#pragma once

#include <cstddef>
#include <string_view>

namespace nezumi {

/// One word or sign. Comments and blanks are left out.
struct Token {
    enum class Kind : unsigned char { name, keyword, literal, sign, end } kind = Kind::end;
    std::string_view text{};  ///< as it stands in the source; of a string literal, all of it
    int line = 1;             ///< from 1
    int column = 1;           ///< from 1 [bytes]
    bool open = false;        ///< a string literal that the source ends in

    bool is(std::string_view word) const { return text == word && (kind == Kind::keyword || kind == Kind::sign); }
};

/// A source text without a byte order mark, and with a first line for the shell ("#!...") emptied: lines keep their
/// numbers.
std::string_view without_preamble(std::string_view source);

/// Reads a source text word by word. Meant for text that Lua has compiled: what is no Lua gives some sequence of
/// tokens, and always comes to an end.
class Lexer {
public:
    explicit Lexer(std::string_view source) : source_(source) {}

    /// The next word; Kind::end for ever at the end.
    Token next();
    /// After Kind::end: the source ends in a comment.
    bool ends_in_comment() const { return in_comment_; }

private:
    char peek(std::size_t ahead = 0) const { return at_ + ahead < source_.size() ? source_[at_ + ahead] : '\0'; }
    void advance();
    void skip_blanks();
    // Both: whether it has an end.
    bool skip_long_bracket(std::size_t level);
    bool skip_string(char quote);
    bool at_long_bracket(std::size_t& level) const;
    void skip_number();

    std::string_view source_;
    std::size_t at_ = 0;
    std::size_t line_start_ = 0;
    int line_ = 1;
    bool in_comment_ = false;
};

}  // namespace nezumi
