// Splits an OMG IDL file into tokens, with the comments before and after them.
#pragma once

#include <string>
#include <string_view>

#include "engine/project/script_source.hpp"

namespace nezumi {

struct IdlToken {
    enum class Kind { end, word, number, text, sign, include, wrong };
    Kind kind = Kind::end;
    std::string_view text{};  ///< for `include` the file's name; for `wrong` what was expected
    int line = 0;
    std::string comment{};  ///< the comment before the token
};

class IdlLexer {
public:
    /// `source` must outlive this object.
    explicit IdlLexer(const SourceText& source) : text_(source.text) {}

    IdlToken next();
    /// Reads a comment after the last token of a line. It does not belong to the next token.
    std::string comment_behind();

private:
    // Skips blanks, comments and directives before a token. Adds the comments to `comment`.
    void skip(std::string& comment);
    bool skip_comment(std::string& comment);
    // Reads a line that begins with '#'. Returns the name of an `#include`.
    std::string_view read_directive();
    void to_end_of_line();
    // Skips from the end of an `#ifdef` line to the end of its `#else` or `#endif` line.
    void skip_conditional();

    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1;
    std::string_view include_;
    bool is_cut_off_ = false;  // the text ends within a comment
};

}  // namespace nezumi
