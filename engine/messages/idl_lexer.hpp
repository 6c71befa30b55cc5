// The tokens of a file in OMG IDL, with the comments before and behind them.
#pragma once

#include <string>
#include <string_view>

#include "engine/project/script_source.hpp"

namespace nezumi {

struct IdlToken {
    enum class Kind { end, word, number, text, sign, include, wrong };
    Kind kind = Kind::end;
    std::string_view text{};  ///< of an `include` the file's name; of a `wrong` one what was expected
    int line = 0;
    std::string comment{};  ///< that stands before it
};

class IdlLexer {
public:
    /// `source` must outlive it.
    explicit IdlLexer(const SourceText& source) : text_(source.text) {}

    IdlToken next();
    /// The comment that stands behind the last token in its line, which is then no comment before the next.
    std::string comment_behind();

private:
    // What neither is a token nor belongs to one.
    void skip(std::string& comment);
    bool skip_comment(std::string& comment);
    // A line that begins with '#'. Returns the name of an `#include`.
    std::string_view read_directive();
    void to_end_of_line();
    // From the end of an `#ifdef`'s line to that of its `#else` or `#endif`.
    void skip_conditional();

    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1;
    std::string_view include_;
};

}  // namespace nezumi
