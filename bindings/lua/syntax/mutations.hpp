// Small changes of a Lua text that act like mistakes. They show whether tests notice mistakes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nezumi {

/// One changed place of a text.
struct Mutation {
    int line = 0;                    ///< of the place
    int statement = 0;               ///< the line in which its statement begins, or the line of an `elseif`
    std::size_t at = 0, length = 0;  ///< [bytes] the piece of text that is replaced
    std::string text;                ///< replaces this piece; has the same number of line ends
    std::string change;              ///< "`<` instead of `>=`"

    /// The changed text.
    std::string of(std::string_view source) const;
};

/// All changes, in order of location: a comparison reversed, `and` for `or`, `not` left out, a sign or an operator of
/// arithmetic changed, a number or a boolean changed, a call left out whose result is not used. Declarations change
/// only in their defaults; log lines, prints and probes do not change. `source` is a text without its preamble; if
/// it has syntax errors, there are no changes.
std::vector<Mutation> mutations_of(std::string_view source);

}  // namespace nezumi
