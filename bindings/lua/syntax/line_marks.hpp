// Adds marks to a Lua text: assignments that note which of its lines and branches run.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nezumi {

/// The name of the table that a marked text sets. It is the argument of its main function.
inline constexpr std::string_view marks_name = "nezumi_marks";

/// A text that sets `nezumi_marks[i] = 1` where mark `i` (from 1) is passed. It has the same lines and
/// results as the original.
struct MarkedText {
    /// Each `if`, `elseif`, `while` and `for` has two ways.
    struct Branch {
        int line = 0;
        std::size_t taken = 0;              ///< the mark of its block
        std::vector<std::size_t> passed{};  ///< marks of the other way; one is enough. Empty: it can't be known
    };

    std::string text;          ///< "": the original can't be marked, because it is wrong, or uses `...` at its top
    std::vector<int> lines{};  ///< of each mark: the line of its statement, 0 for a mark that is only of a branch
    std::vector<Branch> branches{};
};

/// Marks each statement except labels. `source` is a file's text without its preamble.
MarkedText mark_lines(std::string_view source);

}  // namespace nezumi
